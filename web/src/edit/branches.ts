/** Many vessels at once: all of the scan, all branches from a seed, and the vessels of a mask. */
import type { Asked } from '../core/asked';
import type { Edit, Edited, GivenFile, Vector } from '../core/messages';
import { notes } from '../state/store';
import { isTreeShown } from '../state/tidy';
import { commit, isDone } from './committing';

/** Adds all branches that a seed reaches; doubtful ones wait until they are accepted. */
export const addBranches = (engine: Asked, seed: Vector): Promise<boolean> =>
  isDone(commit(engine, { kind: 'add_branches', seed }));

/** Accepts branches that are doubtful. */
export const accept = (engine: Asked, ids: readonly number[]): Promise<boolean> =>
  isDone(commit(engine, { kind: 'accept', ids }));

/** Leaves branches out that are doubtful. */
export const leaveOut = (engine: Asked, ids: readonly number[]): Promise<boolean> =>
  isDone(commit(engine, { kind: 'leave_out', ids }));

/** Adds all vessels of the scan, listed as a tree; doubtful ones wait until they are accepted. */
export async function findVessels(engine: Asked): Promise<boolean> {
  const isFound = await addMany(engine, { kind: 'find_vessels' });
  // Of many vessels the widest one is looked for first, and then what hangs on it.
  isTreeShown.value ||= isFound;
  return isFound;
}

/** Adds the vessels of a mask. */
export const addMask = (engine: Asked, mask: readonly GivenFile[]): Promise<boolean> =>
  addMany(engine, { kind: 'add_mask' }, mask);

/** Adds vessels; what is told of them comes among the notes. */
function addMany(engine: Asked, edit: Edit, mask?: readonly GivenFile[]): Promise<boolean> {
  const then = (edited: Edited) => {
    notes.value = [...new Set([...notes.value, ...edited.notes])];
  };
  return isDone(commit(engine, edit, mask ? { mask, then } : { then }));
}
