/** Clicks and moves of the pointer in a view, while a tool is in use that sets points. */

import { engine } from '../client/shared';
import { Latest } from '../core/latest';
import type { Pair, Vector } from '../core/messages';
import { addClickOnLine } from '../edit/clicks';
import { anchor, candidate, drawn, first, target } from '../edit/drawing';
import { chosenDoubt, isTracing } from '../edit/mode';
import { acceptCandidate, endVessel, setPoint } from '../edit/pointing';
import { takeWhole } from '../edit/whole';
import type { Action, Where } from '../input/bindings';
import { placeCrossHair } from '../link/cross-hair';
import { recover } from '../state/device';
import { crossHair, type ViewName } from '../state/store';
import { tool } from '../state/tool';
import { curveAt, isAt } from './curves';
import type { Projection } from './projection';

/** Which rows of the table hold besides those of the view. */
export const toolRows = (): Where | null => (isTracing() ? 'tracing' : null);

/** A view that points are set in. */
export interface Pointed {
  readonly name: ViewName;
  readonly projection: Projection;
  /** The place at a pixel; in a projection it is to be looked at before it becomes a point. */
  place(at: Pair): Promise<Vector> | Vector;
}

/** Does what a click does with the tool in use; says whether it did anything. */
export function clickWithTool(view: Pointed, action: Action, at: Pair): boolean {
  switch (action) {
    case 'set point':
      void setAt(view, at);
      return true;
    case 'end vessel':
      endAt(view, at);
      return true;
    case 'add point':
      addOnCurve(view, at);
      return true;
    case 'pick':
      return chooseDoubtful(view, at);
    default:
      return false;
  }
}

async function setAt(view: Pointed, at: Pair): Promise<void> {
  const { projection } = view;
  if (candidate.value && isAt(projection, candidate.value, at)) {
    acceptCandidate(engine);
    return;
  }
  // On its own curve a vessel does not go on: a double click adds a point there.
  const hit = curveAt(projection, at);
  if (hit && hit.vessel.id === drawn.value?.id) {
    return;
  }
  try {
    if (projection.isThrough) {
      await propose(view, await view.place(at));
    } else {
      // The point is set before the engine answers anything: Enter may follow at once.
      const point = view.place(at) as Vector;
      void setPoint(engine, point);
      await lookAt(view, point);
    }
  } catch (error) {
    recover(error);
  }
}

/** A place of a projection is shown in the slices before it becomes a point, unless the tool was laid down meanwhile. */
async function propose(view: Pointed, point: Vector): Promise<void> {
  await lookAt(view, point);
  if (isTracing()) {
    candidate.value = point;
  }
}

/** Puts the cross-hair at a place at once, and tells what is there when that is known. */
async function lookAt(view: Pointed, point: Vector): Promise<void> {
  crossHair.value = { point, value: null, vessel: null, arcLength: null };
  const pick = await engine.ask('at', point);
  if (crossHair.value?.point === point) {
    placeCrossHair(pick, view.name);
  }
}

/**
 * A double click ends the vessel at the point that its first click set, or takes the whole vessel where that is its only point; on a
 * curve it adds a point there.
 */
function endAt(view: Pointed, at: Pair): void {
  if (acceptCandidate(engine)) {
    return;
  }
  const hit = curveAt(view.projection, at);
  const isOther = hit && drawn.value && hit.vessel.id !== drawn.value.id;
  const last = anchor.value;
  const isEnd = drawn.value !== null && last !== null && isAt(view.projection, last, at);
  if (hit && !isOther && !isEnd && tool.value === 'trace') {
    first.value = null;
    addOnCurve(view, at);
  } else if (!takeWhole(engine)) {
    endVessel();
  }
}

function addOnCurve({ projection }: Pointed, at: Pair): void {
  const hit = curveAt(projection, at);
  if (hit) {
    void addClickOnLine(engine, hit.vessel.id, hit.point);
  }
}

/** A click on a doubtful branch asks whether it is to be accepted. */
function chooseDoubtful({ projection }: Pointed, at: Pair): boolean {
  const hit = curveAt(projection, at);
  chosenDoubt.value = hit?.vessel.doubt ? hit.vessel.id : null;
  return chosenDoubt.value !== null;
}

const following = new Latest();

/** The live path follows the pointer; one place is asked for at a time. */
export function followPointerAt(view: Pointed, at: Pair): void {
  if (tool.value !== 'trace' || anchor.value === null) {
    return;
  }
  following.run(async () => {
    // Beside the scan there is nothing that the path could lead to.
    target.value = await Promise.resolve(view.place(at)).catch(() => null);
  });
}
