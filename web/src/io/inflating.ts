/** Decompresses gzip, zlib and raw deflate in pieces of bounded size. */
import { Z_BUF_ERROR, Z_NO_FLUSH, Z_OK, Z_STREAM_END, ZStream, zlibInflate, zlibInflateInit2 } from 'pako';
import type { Source } from './source';
import { damaged } from './words';

/** `wrapped` is gzip or zlib, detected by content; `bare` is deflate without a header. */
export type Wrapping = 'wrapped' | 'bare';

const WINDOW_BITS: Readonly<Record<Wrapping, number>> = { wrapped: 47, bare: -15 };
const CHUNK = 1 << 18;
const PIECE = 1 << 20;
/** Limit of empty parts: real files have at most one, at the end. */
const MOST_EMPTY = 1000;
const MAGIC = 2;

export class Part {
  private readonly stream = new ZStream();
  /** Whether the part ended with a valid checksum. */
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
    const status = zlibInflate(this.stream, Z_NO_FLUSH);
    if (status !== Z_OK && status !== Z_STREAM_END && status !== Z_BUF_ERROR) {
      throw damaged(this.subject, 'a compressed stream that is damaged', 'a whole one');
    }
    this.hasEnded = status === Z_STREAM_END;
    return this.stream.output.subarray(0, this.stream.next_out);
  }
}

/** Unpacks up to `wanted` bytes of all parts from byte `start`; checks the checksum of a part that ends with them. */
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
    // One byte more, so that a part ending there verifies its checksum.
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

/** Adds bytes of the file until they show whether another part begins. */
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

export const isGzip = begins;

/** First bytes of a file, unpacked if gzipped; the file may be truncated after them. */
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
    // The bytes before the damage identify the file; reading on fails again.
  }
  return found.subarray(0, length);
}
