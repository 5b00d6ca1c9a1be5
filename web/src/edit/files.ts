/** The document's vessels as files of centerlines, and centerlines that come to a document. */
import type { CenterlineKind, NamedLine, Tracing } from '../core/tracing';
import { nameOf } from './changes';
import { commit, isDone } from './committing';
import { document_ } from './history';

/** All vessels that are not doubtful as a file, also those that are hidden. */
export async function centerlineFile(tracing: Tracing, kind: CenterlineKind): Promise<Blob> {
  const vessels = document_.value.vessels.filter((vessel) => vessel.doubt === null);
  const lines = vessels.map((vessel) => ({ line: vessel.line, name: nameOf(vessel) }));
  return new Blob([await tracing.write(lines, kind)], { type: 'application/octet-stream' });
}

/** Adds vessels that were read from files. */
export function addLoaded(tracing: Tracing, vessels: readonly NamedLine[]): Promise<boolean> {
  const lines = vessels.map(({ line, name }) => ({ line, name }));
  return isDone(commit(tracing, { kind: 'add_lines', lines }));
}
