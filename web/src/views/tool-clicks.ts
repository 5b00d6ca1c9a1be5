/** Handles clicks and pointer moves in a view while a tracing tool is active. */

import { Latest } from '../core/latest';
import type { Pair, Pick, Vector } from '../core/messages';
import { addClickOnLine } from '../edit/clicks';
import { acceptCandidate, endVessel, setPoint, takeWhole } from '../edit/pointing';
import type { Action, Where } from '../input/bindings';
import { jumpTo, placeCrossHair } from '../state/cross-hair';
import { recover } from '../state/device';
import { aimAt, anchor, candidate, drawn, propose, setFirst } from '../state/drawing';
import { forgetLumens, lookForLumens, meant } from '../state/lumens';
import { crossHair, type ViewName } from '../state/store';
import { chooseDoubt, chosenDoubt, isTracing, tool } from '../state/tool';
import { engine } from '../worker/engine';
import { curveAt, isAt } from './curves';
import type { Projection } from './projection';

export const toolRows = (): Where | null => (isTracing() ? 'tracing' : null);

export interface Pointed {
  readonly name: ViewName;
  readonly projection: Projection;
  /** The point at a pixel: in a slice the point itself, in a projection the brightest one on the ray. */
  place(at: Pair): Promise<Pick> | Vector;
}

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
    acceptCandidate();
    return;
  }
  // A click on its own curve does not extend a vessel, since a double click adds a point there.
  const hit = curveAt(projection, at);
  if (hit && hit.vessel.id === drawn.value?.id) {
    return;
  }
  try {
    if (projection.isThrough) {
      await setThrough(view, at);
    } else {
      // The point is set before the engine answers, because the user may press Enter at once.
      await setHere(view, view.place(at) as Vector);
    }
  } catch (error) {
    recover(error);
  }
}

async function setHere(view: Pointed, point: Vector): Promise<void> {
  jumpTo(point);
  showValue(view, point, (await setPoint(point)) ?? (await engine.ask('at', point)));
}

/** A click in a projection sets a point in the displayed lumen, or proposes the brightest point. */
async function setThrough(view: Pointed, at: Pair): Promise<void> {
  const isUnderPointer = lastPointer?.view === view.name && isSame(lastPointer.at, at);
  await (isUnderPointer ? lastPointer?.done : null);
  const shown = isUnderPointer ? meant.value : null;
  if (shown) {
    await setHere(view, shown.point);
    return;
  }
  const pick = (await view.place(at)) as Pick;
  placeCrossHair(pick, view.name);
  // The user must confirm the point in the slices. If the tool has been left meanwhile, nothing is proposed.
  if (isTracing()) {
    propose(pick.point);
  }
}

function showValue(view: Pointed, point: Vector, pick: Pick): void {
  if (crossHair.value?.point === point) {
    placeCrossHair(pick, view.name);
  }
}

/** A double click ends the vessel, traces the whole vessel at its only point, or adds a point on a curve. */
function endAt(view: Pointed, at: Pair): void {
  if (acceptCandidate()) {
    return;
  }
  const hit = curveAt(view.projection, at);
  const isOther = hit && drawn.value && hit.vessel.id !== drawn.value.id;
  const last = anchor.value;
  const isEnd = drawn.value !== null && last !== null && isAt(view.projection, last, at);
  if (hit && !isOther && !isEnd && tool.value === 'trace') {
    setFirst(null);
    addOnCurve(view, at);
  } else if (!takeWhole()) {
    endVessel();
  }
}

function addOnCurve({ projection }: Pointed, at: Pair): void {
  const hit = curveAt(projection, at);
  if (hit) {
    void addClickOnLine(hit.vessel.id, hit.point);
  }
}

function chooseDoubtful({ projection }: Pointed, at: Pair): boolean {
  const hit = curveAt(projection, at);
  chooseDoubt(hit?.vessel.doubt ? hit.vessel.id : null);
  return chosenDoubt.value !== null;
}

const following = new Latest();

/** Last position of the pointer, and the request about it that may still be running. */
let lastPointer: { readonly view: ViewName; readonly at: Pair; readonly done: Promise<void> } | null = null;

const isSame = (a: Pair, b: Pair): boolean => Math.hypot(a[0] - b[0], a[1] - b[1]) < 1;

/** Updates the picture of the lumen and the path preview, for one pointer position at a time. */
export function followPointerAt(view: Pointed, at: Pair): void {
  if (tool.value !== 'trace') {
    forgetLumens();
    return;
  }
  if (!view.projection.isThrough && anchor.value !== null) {
    aimAt(view.place(at) as Vector);
  }
  const done = new Promise<void>((resolve) => {
    following.run(() => lookUnder(view, at).then(resolve, resolve));
  });
  lastPointer = { view: view.name, at, done };
}

async function lookUnder(view: Pointed, at: Pair): Promise<void> {
  const { projection, name } = view;
  const through = projection.along;
  const point = projection.at(at, crossHair.value?.point ?? [0, 0, 0]);
  const lumen = await lookForLumens([name, at], { point, along: through });
  if (through && anchor.value !== null) {
    // Outside the scan there is no path.
    const brightest = () => Promise.resolve(view.place(at)).then(placeOf, () => null);
    aimAt(lumen?.point ?? (await brightest()));
  }
}

const placeOf = (place: Pick | Vector): Vector => ('point' in place ? place.point : place);

/** Called when the pointer has left the view, or the content under it has moved. */
export function forgetPointer(): void {
  forgetLumens();
  lastPointer = null;
}
