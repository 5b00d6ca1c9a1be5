/** Reads a file from begin to end, one piece ahead. */
import type { Bytes, Source } from './source';

const PIECE = 1 << 20;

export class Ahead {
  private next: { readonly start: number; readonly bytes: Promise<Bytes> } | null = null;

  constructor(private readonly source: Source | null) {}

  /** The bytes from `start` on; none at the end of the file. */
  async from(start: number): Promise<Bytes> {
    const asked = this.next?.start === start ? this.next.bytes : this.piece(start);
    this.next = null;
    const bytes = await asked;
    const end = start + bytes.length;
    if (bytes.length > 0 && end < (this.source?.size ?? 0)) {
      const following = this.piece(end);
      // Whoever asks for these bytes is told of an error.
      following.catch(() => undefined);
      this.next = { start: end, bytes: following };
    }
    return bytes;
  }

  private async piece(start: number): Promise<Bytes> {
    return (await this.source?.slice(start, start + PIECE)) ?? new Uint8Array();
  }
}
