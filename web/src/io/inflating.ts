/** Compressed streams (gzip, zlib, bare deflate), unpacked in pieces of bounded size whatever they would like to become. */
import { Z_BUF_ERROR, Z_NO_FLUSH, Z_OK, Z_STREAM_END, ZStream, zlibInflate, zlibInflateInit2 } from 'pako';
import type { Source } from './source';
import { damaged } from './words';

/** What the stream is wrapped in: `wrapped` for gzip or zlib, whichever it turns out to be. */
export type Wrapping = 'wrapped' | 'bare';

const WINDOW_BITS: Readonly<Record<Wrapping, number>> = { wrapped: 47, bare: -15 };
const CHUNK = 1 << 18;
const PIECE = 1 << 20;
/** Parts of a stream that hold nothing: real files have one at most, for a good end. */
const MOST_EMPTY = 1000;
const MAGIC = 2;

/** One part of a compressed stream: takes input where it is hungry, gives output in bounded pieces. */
export class Part {
  private readonly stream = new ZStream();
  /** Whether the part is whole, its check sum right. */
  hasEnded = false;

  constructor(
    wrapping: Wrapping,
    private readonly subject: string,
  ) {
    zlibInflateInit2(this.stream, WINDOW_BITS[wrapping]);
  }

  get isHungry(): boolean {
    return this.stream.avail_in === 0;
  }

  /** Input behind the end. */
  get rest(): Uint8Array {
    return this.stream.input.subarray(this.stream.next_in, this.stream.next_in + this.stream.avail_in);
  }

  give(bytes: Uint8Array): void {
    this.stream.input = bytes;
    this.stream.next_in = 0;
    this.stream.avail_in = bytes.length;
  }

  /** The next bytes of output, at most `limit`. */
  take(limit: number): Uint8Array<ArrayBuffer> {
    this.stream.output = new Uint8Array(limit);
    this.stream.next_out = 0;
    this.stream.avail_out = limit;
    const told = zlibInflate(this.stream, Z_NO_FLUSH);
    if (told !== Z_OK && told !== Z_STREAM_END && told !== Z_BUF_ERROR) {
      throw damaged(this.subject, 'a compressed stream that is damaged', 'a whole one');
    }
    this.hasEnded = told === Z_STREAM_END;
    return this.stream.output.subarray(0, this.stream.next_out);
  }
}

/**
 * Unpacks up to `wanted` bytes of the stream that begins at byte `start`.
 *
 * A stream may have several parts, one after the other; what follows the last is not looked at, nor is what follows
 * the wanted bytes. A part that ends with them has its check sum looked at.
 */
export async function* inflated(
  source: Source,
  start: number,
  wanted: number,
): AsyncGenerator<Uint8Array<ArrayBuffer>> {
  let [part, at, left, empty] = [new Part('wrapped', source.path), start, wanted, 0];
  for (;;) {
    const isAtEnd = part.isHungry && at >= source.size;
    if (part.isHungry && !isAtEnd) {
      const chunk = await source.slice(at, at + CHUNK);
      at += chunk.length;
      part.give(chunk);
    }
    // One byte more than is wanted: it leads a part that ends there to its check sum.
    const piece = part.take(Math.min(left + 1, PIECE));
    if (piece.length > 0 && left > 0) {
      yield piece.subarray(0, left);
    }
    if (piece.length > left) {
      return;
    }
    left -= piece.length;
    empty = piece.length > 0 ? 0 : empty;
    if (part.hasEnded) {
      const rest = await withMore(part.rest, source, at);
      at = Math.max(at, rest.at);
      empty += 1;
      if (left === 0 || !begins(rest.bytes) || empty > MOST_EMPTY) {
        return;
      }
      part = new Part('wrapped', source.path);
      part.give(rest.bytes);
    } else if (isAtEnd && piece.length === 0) {
      break;
    }
  }
  if (left === 0) {
    throw damaged(source.path, 'a compressed stream that breaks off', 'a whole one');
  }
}

/** Bytes behind a part, with some more of the file where they are too few to tell whether another part begins. */
async function withMore(
  rest: Uint8Array,
  source: Source,
  at: number,
): Promise<{ bytes: Uint8Array; at: number }> {
  if (rest.length >= MAGIC) {
    return { bytes: rest, at };
  }
  const more = await source.slice(at, at + CHUNK);
  const bytes = new Uint8Array(rest.length + more.length);
  bytes.set(rest);
  bytes.set(more, rest.length);
  return { bytes, at: at + more.length };
}

function begins(bytes: Uint8Array): boolean {
  return bytes[0] === 0x1f && bytes[1] === 0x8b;
}

/** Whether the bytes are gzipped. */
export const isGzip = begins;

/** Up to `count` first bytes of a file, unpacked where it is gzipped; it may break off behind them. */
export async function firstBytes(source: Source, count: number): Promise<Uint8Array<ArrayBuffer>> {
  const head = await source.slice(0, count);
  if (!begins(head)) {
    return head;
  }
  const found = new Uint8Array(count);
  let length = 0;
  try {
    for await (const piece of inflated(source, 0, count)) {
      found.set(piece, length);
      length += piece.length;
    }
  } catch {
    // What was unpacked before the damage tells what the file is; whoever reads on meets the damage again.
  }
  return found.subarray(0, length);
}
