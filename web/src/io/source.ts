/** A file to read: chosen, dropped, fetched, or a member of an archive. */
import { Failure } from '../core/failure';

export type Bytes = Uint8Array<ArrayBuffer>;

export interface Source {
  /** The path, which messages show as the name of the file. */
  readonly path: string;
  readonly size: number;
  /** Bytes from `start` to `end`; fewer if the file ends earlier. */
  slice(start: number, end: number): Promise<Bytes>;
}

export class BlobSource implements Source {
  constructor(
    readonly path: string,
    private readonly blob: Blob,
  ) {}

  get size(): number {
    return this.blob.size;
  }

  async slice(start: number, end: number): Promise<Bytes> {
    try {
      return new Uint8Array(await this.blob.slice(start, end).arrayBuffer());
    } catch {
      const mend = 'choose it again: it may have been moved or changed since';
      throw new Failure('file', this.path, 'a file that the browser cannot read', 'a readable file', mend);
    }
  }
}

/** Finds a file that another file refers to; null if it is missing. */
export type Beside = (path: string) => Promise<Source | null>;

export function fileName(path: string): string {
  return path.slice(path.lastIndexOf('/') + 1);
}

/** Path of a file that another file names relative to its folder. */
export function besidePath(path: string, name: string): string {
  return path.slice(0, path.lastIndexOf('/') + 1) + name;
}

export function among(sources: readonly Source[]): Beside {
  return async (path) => sources.find((source) => source.path === path) ?? null;
}

/** Sorted by path, as the Python package does. */
export function inOrder(sources: readonly Source[]): Source[] {
  return [...sources].sort((one, other) => (one.path < other.path ? -1 : one.path > other.path ? 1 : 0));
}

const PIECE = 1 << 20;

/** Reads a file in pieces; while one piece is used, the next is already being read. */
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
