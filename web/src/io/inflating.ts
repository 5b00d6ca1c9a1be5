/** Decompresses the beginnings of gzipped files, and deflate streams in pieces of bounded size. */
import { Z_BUF_ERROR, Z_NO_FLUSH, Z_OK, Z_STREAM_END, ZStream, zlibInflate, zlibInflateInit2 } from 'pako';
import type { Bytes, Source } from './source';
import { damaged } from './words';

/** `wrapped` is gzip or zlib, detected by content; `bare` is deflate without a header. */
export type Wrapping = 'wrapped' | 'bare';

const WINDOW_BITS: Readonly<Record<Wrapping, number>> = { wrapped: 47, bare: -15 };
const CHUNK = 1 << 18;
/** Bytes of a file that are looked at for the first ones of its content. */
const MOST = 1 << 20;

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

/** First bytes of a file, unpacked if gzipped; the file may be damaged behind them. */
export async function firstBytes(source: Source, count: number): Promise<Bytes> {
  const head = await source.slice(0, count);
  if (!isGzip(head)) {
    return head;
  }
  const found = new Uint8Array(count);
  let [part, at, length] = [new Part('wrapped', source.path), 0, 0];
  try {
    while (length < count && at < MOST) {
      if (part.hasEnded) {
        const { rest } = part;
        part = new Part('wrapped', source.path);
        part.give(rest);
      }
      if (part.isHungry) {
        const chunk = await source.slice(at, at + CHUNK);
        if (chunk.length === 0) {
          break;
        }
        at += chunk.length;
        part.give(chunk);
      }
      const piece = part.take(count - length);
      found.set(piece, length);
      length += piece.length;
    }
  } catch {
    // The bytes before the damage identify the file; reading on fails again.
  }
  return found.subarray(0, length);
}

function isGzip(bytes: Uint8Array): boolean {
  return bytes[0] === 0x1f && bytes[1] === 0x8b;
}
