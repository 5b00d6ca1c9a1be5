/** Voxels as bytes (plain, compressed or text), without more memory than the file really fills. */
import { EVERY_SECOND } from '../core/mends';
import { inflated } from './inflating';
import { ARRAYS, bytesOf, isInteger, type Kind, limits } from './numbers';
import type { Source } from './source';
import type { Steps } from './steps';
import { damaged, formatFailure, shown } from './words';

export type Codec = 'raw' | 'zlib' | 'text';

/** Where the voxels of a file are. */
export interface Place {
  readonly source: Source;
  /** The first byte of the voxels, or of the compressed stream; negative: they are the file's last bytes. */
  readonly start: number;
  readonly codec: Codec;
  /** Bytes to leave out at the beginning of the unpacked stream. */
  readonly skip: number;
}

export type Bytes = Uint8Array<ArrayBuffer>;

const CHUNK = 1 << 20;
/** No byte of a deflate stream becomes more bytes than this. */
const DEFLATE_LIMIT = 1032;
/** Sizes up to this multiple of the compressed file need no check before memory is allocated. */
const TRUSTED = 8;
/** WebAssembly has no more memory than this. */
const MEMORY = 2 ** 32;
const LONGEST_WORD = 400;

/** Voxels, and how many of them are to be kept. */
interface Kept extends Place {
  readonly share: number;
}

/** Rejects a size that the file does not fill, before allocating its memory. */
export async function requireRoom(place: Kept, needed: number, kind: Kind, steps: Steps): Promise<void> {
  const { source, codec, share } = place;
  const held = Math.max(source.size - Math.max(place.start, 0), 0);
  if (codec === 'text') {
    const least = (2 * needed) / ARRAYS[kind].BYTES_PER_ELEMENT - 1;
    refuseShort(source, held, least);
  } else if (codec === 'raw') {
    refuseShort(source, held, place.skip + needed);
  } else if (place.skip + needed > held * DEFLATE_LIMIT) {
    throw tooShort(source, `at most ${held * DEFLATE_LIMIT}`, place.skip + needed);
  }
  if (share * needed > MEMORY) {
    const found = `${needed} bytes of voxels as the header says`;
    const expected = `at most the ${MEMORY} bytes that a page can hold`;
    throw formatFailure(source.path, found, expected, '', { mends: [EVERY_SECOND] });
  }
  if (codec === 'zlib' && place.skip + needed > TRUSTED * held) {
    await count(place, needed, steps);
  }
}

function refuseShort(source: Source, held: number, needed: number): void {
  if (held < needed) {
    throw tooShort(source, String(held), needed);
  }
}

/** Counts the bytes of a stream that would grow much, by unpacking it once. */
async function count(place: Place, needed: number, steps: Steps): Promise<void> {
  for await (const piece of voxelBytes({ ...place, skip: 0 }, place.skip + needed, 'uint8')) {
    await steps.step('Checking the volume', piece.length, null);
  }
}

/** The bytes of the voxels in pieces, `needed` in all; text becomes numbers of its type in this machine's order. */
export async function* voxelBytes(place: Place, needed: number, kind: Kind): AsyncGenerator<Bytes> {
  let found = 0;
  for await (const piece of pieces(place, needed, kind)) {
    found += piece.length;
    yield piece;
  }
  if (found < needed) {
    throw tooShort(place.source, String(found), needed);
  }
}

function pieces(place: Place, needed: number, kind: Kind): AsyncGenerator<Bytes> {
  switch (place.codec) {
    case 'raw':
      return plain(place, needed);
    case 'zlib':
      return unpacked(place, needed);
    case 'text':
      return parsedText(place, needed, kind);
  }
}

async function* plain({ source, start, skip }: Place, needed: number): AsyncGenerator<Bytes> {
  const first = start < 0 ? source.size - needed : start + skip;
  for (let at = first; at < first + needed; at += CHUNK) {
    yield await source.slice(at, Math.min(at + CHUNK, first + needed));
  }
}

async function* unpacked({ source, start, skip }: Place, needed: number): AsyncGenerator<Bytes> {
  let left = skip;
  for await (const piece of inflated(source, start, skip + needed)) {
    if (piece.length > left) {
      yield piece.subarray(left);
    }
    left = Math.max(left - piece.length, 0);
  }
}

async function* parsedText(
  { source, start, skip }: Place,
  needed: number,
  kind: Kind,
): AsyncGenerator<Bytes> {
  const total = needed / ARRAYS[kind].BYTES_PER_ELEMENT;
  let found = 0;
  for await (const words of wordsOf(source, start + skip)) {
    found += words.length;
    if (found <= total) {
      yield numbers(source, words, kind);
    }
  }
  if (found !== total) {
    throw formatFailure(source.path, `${found} numbers`, `${total} numbers as the header says`);
  }
}

/** The words of a text, read in pieces. */
async function* wordsOf(source: Source, start: number): AsyncGenerator<string[]> {
  let begun = '';
  for (let at = start; at < source.size; at += CHUNK) {
    const text = begun + new TextDecoder('latin1').decode(await source.slice(at, at + CHUNK));
    const words = text.split(/[\s\v\f]+/);
    begun = words.pop() ?? '';
    if (begun.length > LONGEST_WORD) {
      throw formatFailure(source.path, 'a word of many letters among the voxels', 'numbers');
    }
    yield words.filter((word) => word !== '');
  }
  yield begun === '' ? [] : [begun];
}

function numbers(source: Source, words: readonly string[], kind: Kind): Bytes {
  const pattern = isInteger(kind)
    ? /^[+-]?\d+$/
    : /^[+-]?(\d+\.?\d*(e[+-]?\d+)?|\.\d+(e[+-]?\d+)?|nan|inf(inity)?)$/i;
  if (words.some((word) => !pattern.test(word))) {
    throw formatFailure(source.path, 'voxels that are no numbers', `numbers of type ${kind}`);
  }
  if (!isInteger(kind)) {
    const real = (word: string) => Number(word.replace(/inf(inity)?/i, 'Infinity').replace(/nan/i, 'NaN'));
    return bytesOf(new ARRAYS[kind as 'float64'](words.map(real)));
  }
  const whole = words.map((word) => BigInt(word.replace('+', '')));
  const [least, most] = limits(kind);
  const odd = whole.find((value) => value < least || value > most);
  if (odd !== undefined) {
    throw formatFailure(source.path, shown(`a voxel of ${odd}`), `${least} to ${most}, as ${kind} holds`);
  }
  const isWide = kind === 'int64' || kind === 'uint64';
  return bytesOf(
    isWide ? new ARRAYS[kind](whole) : new ARRAYS[kind as 'int32'](whole.map((value) => Number(value))),
  );
}

function tooShort(source: Source, found: string, needed: number): Error {
  return damaged(source.path, `${found} bytes of voxels`, `${needed} bytes as the header says`);
}
