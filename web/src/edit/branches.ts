/** Many vessels at once: all of the scan, all branches from a seed, and the vessels of a mask. */
import type { Asked } from '../core/asked';
import type { Edited, GivenFile, Vector } from '../core/messages';
import { notes } from '../state/store';
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

/** Adds all vessels of the scan; doubtful ones wait until they are accepted. */
export const findVessels = (engine: Asked): Promise<boolean> =>
  isDone(commit(engine, { kind: 'find_vessels' }, { then: tell }));

/** Adds the vessels of a mask; what was odd about it is told among the notes. */
export const addMask = (engine: Asked, mask: readonly GivenFile[]): Promise<boolean> =>
  isDone(commit(engine, { kind: 'add_mask' }, { mask, then: tell }));

function tell({ notes: told }: Edited): void {
  notes.value = [...new Set([...notes.value, ...told])];
}
