/** A file to read from: chosen, dropped, fetched, or a member of an archive. */
import { Failure } from '../core/failure';

export interface Source {
  /** Its name with the folders that it came with; it names the file in messages. */
  readonly path: string;
  readonly size: number;
  /** The bytes from `start` up to `end`, fewer where the file ends before. */
  slice(start: number, end: number): Promise<Uint8Array<ArrayBuffer>>;
}

/** A file of the browser. */
export class BlobSource implements Source {
  constructor(
    readonly path: string,
    private readonly blob: Blob,
  ) {}

  get size(): number {
    return this.blob.size;
  }

  async slice(start: number, end: number): Promise<Uint8Array<ArrayBuffer>> {
    try {
      return new Uint8Array(await this.blob.slice(start, end).arrayBuffer());
    } catch {
      const mend = 'choose it again: it may have been moved or changed since';
      throw new Failure('file', this.path, 'a file that the browser cannot read', 'a readable file', mend);
    }
  }
}

/** Finds the file that another one names, null where it is not there. */
export type Beside = (path: string) => Promise<Source | null>;

/** The name of a file without its folders. */
export function fileName(path: string): string {
  return path.slice(path.lastIndexOf('/') + 1);
}

/** The path of a file in the folder of another one, or below it. */
export function besidePath(path: string, name: string): string {
  return path.slice(0, path.lastIndexOf('/') + 1) + name;
}

/** Finds files among those that were given together. */
export function among(sources: readonly Source[]): Beside {
  return async (path) => sources.find((source) => source.path === path) ?? null;
}

/** Files in the order of their names, as Python sorts them. */
export function inOrder(sources: readonly Source[]): Source[] {
  return [...sources].sort((one, other) => (one.path < other.path ? -1 : one.path > other.path ? 1 : 0));
}
