/** Reads a stream of bytes in pieces of any requested length. */
export class ByteReader {
  private readonly reader: ReadableStreamDefaultReader<Uint8Array>;
  private held = new Uint8Array();
  count = 0;

  constructor(stream: ReadableStream<Uint8Array>) {
    this.reader = stream.getReader();
  }

  /** The next `length` bytes; fewer if the stream ends earlier. */
  async take(length: number): Promise<Uint8Array> {
    while (this.held.length < length && (await this.more())) {}
    return this.cut(Math.min(length, this.held.length));
  }

  /** All bytes that have arrived, in a multiple of `unit`. Waits for at least one unit; empty at the end. */
  async takeWhole(unit: number): Promise<Uint8Array> {
    while (this.held.length < unit && (await this.more())) {}
    return this.cut(this.held.length - (this.held.length % unit));
  }

  private cut(length: number): Uint8Array {
    const taken = this.held.slice(0, length);
    this.held = this.held.subarray(length);
    this.count += length;
    return taken;
  }

  private async more(): Promise<boolean> {
    const { value, done } = await this.reader.read();
    if (done || !value) {
      return false;
    }
    if (this.held.length === 0) {
      this.held = value as Uint8Array<ArrayBuffer>;
    } else {
      const joined = new Uint8Array(this.held.length + value.length);
      joined.set(this.held);
      joined.set(value, this.held.length);
      this.held = joined;
    }
    return true;
  }
}
