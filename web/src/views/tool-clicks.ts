/** Clicks and moves of the pointer in a view, while a tool is in use that sets points. */

import { engine } from '../client/shared';
import { Latest } from '../core/latest';
import type { Pair, Pick, Vector } from '../core/messages';
import { addClickOnLine } from '../edit/clicks';
import { anchor, candidate, drawn, first, target } from '../edit/drawing';
import { lookForLumens, meant, pointed } from '../edit/lumens';
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
  /** The place at a pixel of a slice; the brightest one on its ray, and what lies there, in a projection. */
  place(at: Pair): Promise<Pick> | Vector;
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
      await setThrough(view, at);
    } else {
      // The point is set before the engine answers anything: Enter may follow at once.
      await setHere(view, view.place(at) as Vector);
    }
  } catch (error) {
    recover(error);
  }
}

/** Sets a point, with the cross-hair there at once. */
async function setHere(view: Pointed, point: Vector): Promise<void> {
  crossHair.value = { point, value: null, vessel: null, arcLength: null };
  tell(view, point, (await setPoint(engine, point)) ?? (await engine.ask('at', point)));
}

/** In a projection a click takes the lumen that is shown beside the pointer; without one it proposes the brightest place. */
async function setThrough(view: Pointed, at: Pair): Promise<void> {
  const isUnderPointer = looked?.view === view.name && isSame(looked.at, at);
  await (isUnderPointer ? looked?.done : null);
  const shown = isUnderPointer ? meant.value : null;
  if (shown) {
    await setHere(view, shown.point);
    return;
  }
  const pick = (await view.place(at)) as Pick;
  placeCrossHair(pick, view.name);
  // It is looked at in the slices before it becomes a point, unless the tool was laid down meanwhile.
  if (isTracing()) {
    candidate.value = pick.point;
  }
}

/** Tells what is at a place, unless the cross-hair was put elsewhere meanwhile. */
function tell(view: Pointed, point: Vector, pick: Pick): void {
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

/** What the pointer was last over, and when it is known what is there. */
let looked: { readonly view: ViewName; readonly at: Pair; readonly done: Promise<void> } | null = null;

const isSame = (a: Pair, b: Pair): boolean => Math.hypot(a[0] - b[0], a[1] - b[1]) < 1;

/** The lumen beside the pointer and the live path follow it; one place is asked for at a time. */
export function followPointerAt(view: Pointed, at: Pair): void {
  if (tool.value !== 'trace') {
    pointed.value = null;
    return;
  }
  if (!view.projection.isThrough && anchor.value !== null) {
    target.value = view.place(at) as Vector;
  }
  const done = new Promise<void>((resolve) => {
    following.run(() => lookUnder(view, at).then(resolve, resolve));
  });
  looked = { view: view.name, at, done };
}

async function lookUnder(view: Pointed, at: Pair): Promise<void> {
  const { projection, name } = view;
  const through = projection.along;
  const point = projection.at(at, crossHair.value?.point ?? [0, 0, 0]);
  const lumen = await lookForLumens(engine, [name, at], { point, along: through });
  if (through && anchor.value !== null) {
    // Beside the scan there is nothing that the path could lead to.
    const brightest = () => Promise.resolve(view.place(at)).then(placeOf, () => null);
    target.value = lumen?.point ?? (await brightest());
  }
}

const placeOf = (place: Pick | Vector): Vector => ('point' in place ? place.point : place);

/** The pointer has left the view, or it is turned or scrolled: what was under it is no longer there. */
export function forgetPointer(): void {
  pointed.value = null;
  looked = null;
}
