/** Writes the vessels as a centerline file, and adds centerlines from files. */

import type { CenterlineKind, NamedLine } from '../core/messages';
import { nameOf } from '../state/changes';
import { document_ } from '../state/history';
import { engine } from '../worker/engine';
import { commit, isDone } from './committing';

/** A centerline file of all vessels, also hidden ones, but without doubtful ones. */
export async function centerlineFile(kind: CenterlineKind): Promise<Blob> {
  const vessels = document_.value.vessels.filter((vessel) => vessel.doubt === null);
  const lines = vessels.map((vessel) => ({ line: vessel.line, name: nameOf(vessel) }));
  return new Blob([(await engine.ask('write_lines', { lines, kind })).bytes], {
    type: 'application/octet-stream',
  });
}

export function addLoaded(vessels: readonly NamedLine[]): Promise<boolean> {
  const lines = vessels.map(({ line, name }) => ({ line, name }));
  return isDone(commit({ kind: 'add_lines', lines }));
}
