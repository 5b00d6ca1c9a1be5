/** Reads the stored values of slices, before rescaling. */
import { type Kind, type Numbers, numbersOf } from '../numbers';
import type { Bytes } from '../source';
import { damaged, formatFailure } from '../words';
import { CODECS, type CodecName, decoderOf, forgetDecoder } from './codecs';
import type { Decoded } from './decoded';
import { Frames, frameBytes, NATIVE, type Shape, shapeOf } from './frames';
import type { Image } from './headers';
import { unpackRle } from './rle';
import { codestreamSize, jpegSize } from './stream-size';

export const RLE = '1.2.840.10008.1.2.5';
export const TRANSFER_SYNTAXES: readonly string[] = [...NATIVE, RLE, ...Object.keys(CODECS)];

/** Decoded size of a frame that is always allowed (bytes); an empty frame may compress to a hundred bytes. */
const ALWAYS_ALLOWED = 16 << 20;
/** Largest compression factor that is accepted; no codec reaches it on real slices. */
const COMPRESSION_LIMIT = 10_000;

/** Reads slices one at a time, and caches the file read last. */
export class PixelReader {
  private frames: Frames | null = null;

  async read(image: Image, frame: number): Promise<Numbers> {
    if (this.frames?.image !== image) {
      this.frames = new Frames(image);
    }
    const { frames } = this;
    const shape = shapeOf(image);
    const bytes = await frames.frame(frame);
    const syntax = image.header.transfer_syntax;
    if (NATIVE.includes(syntax)) {
      return nativeNumbers(image, shape, bytes);
    }
    if (frameBytes(shape) > Math.max(ALWAYS_ALLOWED, bytes.length * COMPRESSION_LIMIT)) {
      throw frames.tooShort(bytes.length);
    }
    const path = image.source.path;
    const stored =
      syntax === RLE ? unpackedRle(path, shape, bytes) : await decoded(path, syntax, shape, bytes);
    return used(stored, shape);
  }
}

export function kindOf(image: Image, shape: Shape): Kind {
  const bits = shape.bitsAllocated;
  if (image.pixels?.keyword !== 'PixelData') {
    return bits === 64 ? 'float64' : 'float32';
  }
  return `${shape.isSigned ? '' : 'u'}int${bits}` as Kind;
}

function nativeNumbers(image: Image, shape: Shape, bytes: Bytes): Numbers {
  const kind = kindOf(image, shape);
  if (image.isBig && shape.bitsAllocated === 8 && image.pixels?.vr === 'OW') {
    // Swaps the two bytes of each 16-bit word, since the high byte comes first.
    const swapped = numbersOf({ kind: 'uint16', isBig: true }, bytes);
    return used(numbersOf({ kind, isBig: false }, new Uint8Array(swapped.buffer as ArrayBuffer)), shape);
  }
  return used(numbersOf({ kind, isBig: image.isBig }, bytes), shape);
}

/** Clears the bits above `bitsStored`; for signed samples the highest stored bit is the sign. */
function used(numbers: Numbers, { bitsAllocated, bitsStored }: Shape): Numbers {
  const unused = bitsAllocated - bitsStored;
  if (unused <= 0 || unused >= bitsAllocated || !(numbers instanceof Int8Array || isSmall(numbers))) {
    return numbers;
  }
  const result = numbers as Int16Array<ArrayBuffer>;
  for (let i = 0; i < result.length; i += 1) {
    // Storing in the typed array truncates the value; shifting back extends the sign.
    result[i] = (result[i] ?? 0) << unused;
    result[i] = (result[i] ?? 0) >> unused;
  }
  return result;
}

function isSmall(numbers: Numbers): boolean {
  return [Uint8Array, Int16Array, Uint16Array, Int32Array].some((type) => numbers instanceof type);
}

function unpackedRle(path: string, shape: Shape, frame: Bytes): Numbers {
  const unit = shape.bitsAllocated / 8;
  const bytes = unpackRle(frame, shape.rows * shape.columns, unit);
  if (!bytes) {
    throw damaged(path, 'damaged pixels', 'pixels that can be decoded');
  }
  return numbersOf({ kind: `${shape.isSigned ? '' : 'u'}int${8 * unit}` as Kind, isBig: false }, bytes);
}

async function decoded(path: string, syntax: string, shape: Shape, frame: Bytes): Promise<Numbers> {
  const name = CODECS[syntax];
  if (!name) {
    throw formatFailure(path, `pixels of the transfer syntax ${syntax}`, 'a supported transfer syntax');
  }
  requireSize(path, name, shape, frame);
  const decode = await decoderOf(name);
  let made: Decoded;
  try {
    made = decode(frame);
  } catch {
    forgetDecoder(name);
    throw damaged(path, 'damaged pixels', 'pixels that can be decoded');
  }
  if (made.bytes.length !== shape.rows * shape.columns * made.unit) {
    throw damaged(path, 'damaged pixels', 'pixels that can be decoded');
  }
  const sign = shape.isSigned ? '' : 'u';
  const numbers = numbersOf({ kind: `${sign}int${8 * made.unit}` as Kind, isBig: false }, made.bytes);
  return made.unit === 1 && shape.bitsAllocated > 8
    ? new (shape.isSigned ? Int16Array : Uint16Array)(made.bytes)
    : numbers;
}

/** Rejects a frame whose size differs from the header's, before its decoder allocates memory. */
function requireSize(path: string, name: CodecName, shape: Shape, frame: Bytes): void {
  const isCodestream = name === 'jpeg2000' || name === 'highThroughput';
  const size = isCodestream ? codestreamSize(frame) : jpegSize(frame);
  if (!size) {
    throw damaged(
      path,
      `pixels without a ${isCodestream ? 'codestream' : 'frame'}`,
      isCodestream ? 'JPEG 2000' : 'JPEG',
    );
  }
  if (size.columns !== shape.columns || size.rows !== shape.rows || size.components !== 1) {
    const what = isCodestream ? 'codestream' : 'frame';
    const found = `a ${what} of ${size.columns} × ${size.rows} pixels, ${size.components} values each`;
    throw formatFailure(path, found, `${shape.columns} × ${shape.rows} as the header says`);
  }
  if (name === 'jpeg' && size.bits > 8) {
    const mend = 'write the series without compression, or convert it with the Python package';
    throw formatFailure(
      path,
      `JPEG Extended of ${size.bits} bits`,
      'JPEG Extended of 8 bits, or another compression',
      mend,
    );
  }
}
