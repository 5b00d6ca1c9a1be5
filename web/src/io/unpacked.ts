/** Gzipped files that the browser unpacks, so that the module of volume files needs no decoder. */
import { Ahead, type Bytes, type Source } from './source';

/** Compressed bytes that are unpacked at once; they become at most a thousand times as many. */
const PACKED = 1 << 17;
/** Streams that grow more are left to the module, which proves that they hold the voxels before there is room. */
const TRUSTED = 8;
const NONE: Bytes = new Uint8Array();
const LEAST = 18;

/** A stream that the browser cannot verify; the module with decoders reads it and states what is wrong. */
export class Unverified extends Error {}

/** The content of the only gzip stream in the rest of a file. It is verified only when `finish` returns. */
export class Unpacked implements Source {
  private reader: ReadableStreamDefaultReader<Bytes> | null = null;
  private held: Bytes = NONE;
  private at = 0;

  private constructor(
    private readonly packed: Source,
    private readonly first: number,
    readonly size: number,
  ) {}

  /** The stream that begins at byte `from`; null if it is not gzip, or grows too much. */
  static async of(packed: Source, from: number): Promise<Unpacked | null> {
    const [head, tail] = [
      await packed.slice(from, from + 2),
      await packed.slice(packed.size - 4, packed.size),
    ];
    const length = packed.size - from;
    if (head[0] !== 0x1f || head[1] !== 0x8b || length < LEAST || tail.length < 4) {
      return null;
    }
    // The last four bytes are the size of the content.
    const size = new DataView(tail.buffer, tail.byteOffset).getUint32(0, true);
    return size <= TRUSTED * length ? new Unpacked(packed, from, size) : null;
  }

  get path(): string {
    return this.packed.path;
  }

  get isBegun(): boolean {
    return this.reader !== null;
  }

  async from(start: number): Promise<Bytes> {
    if (start < this.at) {
      await this.close();
    }
    while (this.at < start && (await this.more())) {
      this.skip(start - this.at);
    }
    await this.more();
    const piece = this.held;
    this.skip(piece.length);
    return piece;
  }

  async slice(start: number, end: number): Promise<Bytes> {
    const bytes = new Uint8Array(Math.max(Math.min(end, this.size) - start, 0));
    let count = 0;
    while (count < bytes.length) {
      const piece = await this.from(start + count);
      if (piece.length === 0) {
        break;
      }
      const used = Math.min(piece.length, bytes.length - count);
      bytes.set(piece.subarray(0, used), count);
      count += used;
      this.held = piece.subarray(used);
      this.at -= this.held.length;
    }
    return bytes.subarray(0, count);
  }

  /** Unpacks the rest; fails unless the check sum and the size of the content are right, and nothing follows. */
  async finish(heed: () => Promise<void>): Promise<void> {
    while (await this.more()) {
      this.skip(this.held.length);
      await heed();
    }
    if (this.at !== this.size) {
      throw new Unverified();
    }
  }

  async close(): Promise<void> {
    await this.reader?.cancel().catch(() => undefined);
    [this.reader, this.held, this.at] = [null, NONE, 0];
  }

  private skip(count: number): void {
    const skipped = Math.min(count, this.held.length);
    this.held = this.held.subarray(skipped);
    this.at += skipped;
  }

  private async more(): Promise<boolean> {
    this.reader ??= this.content().getReader();
    while (this.held.length === 0) {
      const { done, value } = await this.reader.read().catch(() => {
        throw new Unverified();
      });
      if (done) {
        return false;
      }
      this.held = value;
    }
    return true;
  }

  private content(): ReadableStream<Bytes> {
    const ahead = new Ahead(this.packed);
    let [at, piece]: [number, Bytes] = [this.first, NONE];
    const packed = new ReadableStream<Bytes>(
      {
        pull: async (stream) => {
          if (piece.length === 0) {
            piece = await ahead.from(at);
            at += piece.length;
          }
          if (piece.length === 0) {
            stream.close();
          } else {
            stream.enqueue(piece.subarray(0, PACKED));
            piece = piece.subarray(PACKED);
          }
        },
      },
      { highWaterMark: 0 },
    );
    return packed.pipeThrough(new DecompressionStream('gzip'));
  }
}
