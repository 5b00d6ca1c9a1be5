/** Asks the engine what a file is, by its first bytes and its name. */
import type { KnownFile } from '../core/generated/questions';
import { firstBytes } from './inflating';
import { fileName, type Source } from './source';

export interface Known extends KnownFile {
  readonly source: Source;
}

/** Names the kind of a file from the first bytes, as characters 0 to 255, and the name. */
export type KindOf = (head: string, name: string) => KnownFile;

/** Number of bytes that the engine examines. */
const HEAD = 4096;

export async function known(source: Source, kindOf: KindOf): Promise<Known> {
  const inflated = await firstBytes(source, HEAD);
  // The kind of a damaged gzip file is decided by its name.
  const head = inflated.length > 0 ? inflated : await source.slice(0, HEAD);
  return { source, ...kindOf(String.fromCharCode(...head), fileName(source.path)) };
}
