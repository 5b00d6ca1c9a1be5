/** What a click, Enter and Escape do with the tools that trace. */
import { batch } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Failure } from '../core/failure';
import type { Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { crossHair } from '../state/store';
import { tell } from '../state/telling';
import { active, tool } from '../state/tool';
import { addBranches } from './branches';
import { addClick, beginVessel, removeClick } from './clicks';
import { forgetRefusal, refusal, searches, tellRefusal } from './committing';
import { anchor, candidate, coming, drawing, drawn, first, forgetDrawing, isDrawing } from './drawing';
import { addStopper } from './stoppers';

/** Places as near as this are one place (mm). */
const SAME = 0.05;

/** The vessel that is being begun, as long as it is traced for the first time. */
let beginning: Promise<number | null> | null = null;

/** Sets a point of a vessel, a stopper, or where a tree begins; nothing while vessels are looked for. */
export async function setPoint(engine: Asked, point: Vector): Promise<void> {
  candidate.value = null;
  if (searches.value > 0) {
    tell('No point was set: vessels are being looked for. Escape stops that.');
  } else if (tool.value === 'stopper') {
    await addStopper(engine, point);
  } else if (tool.value === 'seed') {
    await beginTree(engine, point);
  } else if (anchor.value === null) {
    forgetRefusal();
    first.value = point;
    await checkFirst(engine, point);
  } else {
    const own = { point, drawing: drawing.value };
    coming.value = [...coming.value, own];
    await goOn(engine, point);
    coming.value = coming.value.filter((one) => one !== own);
  }
}

/** Looks for all branches from a place; where none are found another place can be clicked. */
async function beginTree(engine: Asked, point: Vector): Promise<void> {
  if ((await addBranches(engine, point)) && tool.value === 'seed') {
    tool.value = 'look';
  }
}

async function goOn(engine: Asked, point: Vector): Promise<void> {
  if (drawn.value) {
    await addClick(engine, drawn.value.id, point);
  } else if (beginning) {
    const id = await beginning;
    await (id === null ? null : addClick(engine, id, point));
  } else if (first.value) {
    const own = drawing.value;
    // A vessel that was ended while it was traced does not go on.
    const goesOn = () => own === drawing.value;
    beginning = beginVessel(engine, [first.value, point], (id) => {
      if (goesOn()) {
        batch(() => {
          active.value = id;
          first.value = null;
        });
      }
    });
    const begun = await beginning;
    if (goesOn()) {
      beginning = null;
      // Where the first point is to blame, another one is to be set: no second one would help.
      first.value = begun === null && !isBlamed(first.value) ? first.value : null;
    }
  }
}

/** Takes a first point back at once that no vessel can begin at: no second one would make a vessel of it. */
async function checkFirst(engine: Asked, point: Vector): Promise<void> {
  const refused = await engine.ask('check_click', point).then(() => null, Failure.of);
  if (refused && first.value === point) {
    first.value = null;
    tellRefusal(refused);
  }
}

/** Whether a click was refused for a point, and not for what lies behind it. */
function isBlamed(point: Vector | null): boolean {
  const place = refusal.value?.failure.place;
  return Boolean(point && place && length(subtract(place, point)) < SAME);
}

/** Accepts the place of a projection; says whether there was one. */
export function acceptCandidate(engine: Asked): boolean {
  const point = candidate.value;
  if (point) {
    void setPoint(engine, point);
  }
  return point !== null;
}

/** Enter: accepts the place of a projection, else sets a point at the cross-hair; twice at one place ends the vessel. */
export function enter(engine: Asked): void {
  const place = crossHair.value?.point;
  if (acceptCandidate(engine) || !place) {
    return;
  }
  const last = anchor.value;
  if (tool.value === 'trace' && last && isAtCrossHair(last)) {
    endVessel();
  } else {
    void setPoint(engine, place);
  }
}

/** Whether a place is that of the cross-hair. */
export function isAtCrossHair(place: Vector): boolean {
  const point = crossHair.value?.point;
  return point !== undefined && length(subtract(place, point)) < SAME;
}

/** Ends the vessel that is drawn: points of it that are still traced come to it, and the next one begins another vessel. */
export function endVessel(): void {
  beginning = null;
  batch(() => {
    drawing.value += 1;
    active.value = null;
    forgetDrawing();
  });
}

/** One step back out of a tool: from a place of a projection, from a vessel, from the tool. Says whether there was one. */
export function leave(): boolean {
  if (tool.value === 'look') {
    return false;
  }
  if (candidate.value) {
    candidate.value = null;
  } else if (isDrawing.value) {
    endVessel();
  } else {
    tool.value = 'look';
  }
  return true;
}

/** Removes the last point that was set of the vessel that is drawn. */
export function removeLast(engine: Asked): void {
  const clicks = drawn.value?.clicks;
  if (candidate.value) {
    candidate.value = null;
  } else if (drawn.value && clicks) {
    const kept = clicks.length === 2 ? (clicks[0] ?? null) : null;
    void removeClick(engine, drawn.value.id, clicks.length - 1).then(() => {
      first.value = kept;
    });
  } else {
    first.value = null;
  }
}
