/** Adds many vessels at once: all of a scan, those connected to a seed, those of a mask or a centerline file. */

import type { DocumentVessel, Edit, Edited, GivenFile, NamedLine, Vector } from '../core/messages';
import { flyToAnswer } from '../state/flight';
import { document_ } from '../state/history';
import { showFailure } from '../state/message';
import { openList } from '../state/panels';
import { goToVessel, pickOnceShown } from '../state/shown';
import { addDoubts, addNotes, camera } from '../state/store';
import { engine } from '../worker/engine';
import { commit, isDone } from './committing';
import { maskOf, namedBySegment } from './segmentation';

/** Adds all branches connected to a seed. Doubtful ones are only added once the user accepts them. */
export const addBranches = (seed: Vector): Promise<boolean> => addMany({ kind: 'add_branches', seed });

export const accept = (ids: readonly number[]): Promise<boolean> => isDone(commit({ kind: 'accept', ids }));

export const leaveOut = (ids: readonly number[]): Promise<boolean> =>
  isDone(commit({ kind: 'leave_out', ids }));

/** Adds all vessels of the scan as a tree. Fails if all are doubtful, unless `doubtful` is set. */
export async function findVessels(doubtful = false): Promise<boolean> {
  const isFirst = sure().length === 0;
  const isFound = await addMany({ kind: 'find_vessels', doubtful });
  if (isFound && isFirst) {
    await showMain();
  }
  return isFound;
}

const sure = () => document_.value.vessels.filter((vessel) => vessel.doubt === null);

/** Picks the root of the main tree, which the engine lists first, and turns the view so that most of it is visible. */
async function showMain(): Promise<void> {
  try {
    const [vessel] = sure();
    if (vessel && camera.value) {
      pickOnceShown(vessel.id);
      goToVessel(vessel.id, null);
      await flyToAnswer(engine.ask('best_view', { camera: camera.value, line: vessel.line }));
    }
  } catch (error) {
    showFailure(error);
  }
}

export async function findAndList(doubtful = false): Promise<void> {
  if (await findVessels(doubtful)) {
    openList();
  }
}

export const addMask = (mask: readonly GivenFile[]): Promise<boolean> => addMany({ kind: 'add_mask' }, mask);

export async function addSegmentation(file: GivenFile): Promise<boolean> {
  try {
    const { mask, names, notes: maskNotes } = await maskOf(file);
    addNotes(maskNotes);
    return await addMany({ kind: 'add_mask' }, mask, (vessel) => namedBySegment(vessel, names));
  } catch (error) {
    showFailure(error);
    return false;
  }
}

export function addLoaded(vessels: readonly NamedLine[]): Promise<boolean> {
  const lines = vessels.map(({ line, name }) => ({ line, name }));
  return isDone(commit({ kind: 'add_lines', lines }));
}

function addMany(
  edit: Edit,
  mask?: readonly GivenFile[],
  renamed?: (vessel: DocumentVessel) => DocumentVessel,
): Promise<boolean> {
  const then = ({ notes, doubts }: Edited) => {
    addNotes(notes);
    addDoubts(doubts);
  };
  return isDone(commit(edit, { then, ...(mask && { mask }), ...(renamed && { renamed }) }));
}
