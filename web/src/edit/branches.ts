/** Many vessels at once: all of the scan, all branches from a seed, and the vessels of a mask. */
import type { Asked } from '../core/asked';
import type { Edit, Edited, GivenFile, Vector } from '../core/messages';
import { notes } from '../state/store';
import { commit, isDone } from './committing';
import { openList } from './list-open';

/** Adds all branches that a seed reaches; doubtful ones wait until they are accepted. */
export const addBranches = (engine: Asked, seed: Vector): Promise<boolean> =>
  isDone(commit(engine, { kind: 'add_branches', seed }));

/** Accepts branches that are doubtful. */
export const accept = (engine: Asked, ids: readonly number[]): Promise<boolean> =>
  isDone(commit(engine, { kind: 'accept', ids }));

/** Leaves branches out that are doubtful. */
export const leaveOut = (engine: Asked, ids: readonly number[]): Promise<boolean> =>
  isDone(commit(engine, { kind: 'leave_out', ids }));

/**
 * Adds all vessels of the scan, listed as a tree; doubtful ones wait until they are accepted. Where none is sure that is refused,
 * unless `doubtful` ones are wanted all the same.
 */
export async function findVessels(engine: Asked, doubtful = false): Promise<boolean> {
  return await addMany(engine, { kind: 'find_vessels', doubtful });
}

/** Finds all vessels; what was found, and what of it is doubtful, is told in the list. */
export async function findAndList(engine: Asked, doubtful = false): Promise<void> {
  if (await findVessels(engine, doubtful)) {
    openList();
  }
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
