/** Reads a file in pieces; while one piece is used, the next is already being read. */
import type { Bytes, Source } from './source';

const PIECE = 1 << 20;

export class Ahead {
  private next: { readonly start: number; readonly bytes: Promise<Bytes> } | null = null;

  constructor(private readonly source: Source | null) {}

  /** The next piece, from byte `start` on; empty at the end of the file. */
  async from(start: number): Promise<Bytes> {
    const asked = this.next?.start === start ? this.next.bytes : this.piece(start);
    this.next = null;
    const bytes = await asked;
    const end = start + bytes.length;
    if (bytes.length > 0 && end < (this.source?.size ?? 0)) {
      const following = this.piece(end);
      // An error is reported when these bytes are requested.
      following.catch(() => undefined);
      this.next = { start: end, bytes: following };
    }
    return bytes;
  }

  private async piece(start: number): Promise<Bytes> {
    return (await this.source?.slice(start, start + PIECE)) ?? new Uint8Array();
  }
}
