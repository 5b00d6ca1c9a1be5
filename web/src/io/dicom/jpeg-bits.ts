/** Reads bits and Huffman codes of compressed JPEG data. */
import type { Bytes } from '../source';

/** How many bits a decoder may read beyond the end of the data. */
const LOOK_AHEAD = 32;
const CODE_BITS = 16;

export class DamagedScan extends Error {}

export class Bits {
  private held = 0;
  private count = 0;
  private missing = 0;

  constructor(
    private readonly bytes: Bytes,
    public at: number,
  ) {}

  /** The next 16 bits; the position does not change. */
  peek(): number {
    this.fill(CODE_BITS);
    return (this.held >>> (this.count - CODE_BITS)) & 0xffff;
  }

  skip(count: number): void {
    this.count -= count;
    if (this.missing > this.count + LOOK_AHEAD) {
      throw new DamagedScan();
    }
  }

  take(count: number): number {
    this.fill(count);
    const value = (this.held >>> (this.count - count)) & ((1 << count) - 1);
    this.skip(count);
    return value;
  }

  restart(): void {
    [this.held, this.count, this.missing] = [0, 0, 0];
    const isMarker = this.bytes[this.at] === 0xff && ((this.bytes[this.at + 1] ?? 0) & 0xf8) === 0xd0;
    if (!isMarker) {
      throw new DamagedScan();
    }
    this.at += 2;
  }

  private fill(count: number): void {
    while (this.count < count) {
      this.held = ((this.held << 8) | this.nextByte()) & 0xffffff;
      this.count += 8;
    }
  }

  /** The next byte, or zero after the end. Using too many of these zeros counts as damage. */
  private nextByte(): number {
    const byte = this.bytes[this.at];
    if (byte === undefined || (byte === 0xff && this.bytes[this.at + 1] !== 0)) {
      this.missing += 8;
      return 0;
    }
    this.at += byte === 0xff ? 2 : 1;
    return byte;
  }
}

/** Huffman table: length and value of the first code in any 16 bits. */
export class Codes {
  private readonly table = new Uint16Array(1 << CODE_BITS);

  constructor(counts: Bytes, symbols: Bytes) {
    let [code, next] = [0, 0];
    for (let length = 1; length <= CODE_BITS; length += 1) {
      const step = 1 << (CODE_BITS - length);
      for (let i = 0; i < (counts[length - 1] ?? 0); i += 1) {
        this.table.fill((length << 8) | (symbols[next] ?? 0), code, code + step);
        code += step;
        next += 1;
      }
    }
  }

  read(bits: Bits): number {
    const found = this.table[bits.peek()] ?? 0;
    if (found === 0) {
      throw new DamagedScan();
    }
    bits.skip(found >> 8);
    return found & 0xff;
  }
}
