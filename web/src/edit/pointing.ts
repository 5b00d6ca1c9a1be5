/** Clicks, Enter and Escape in the tracing tools. */

import { batch } from '@preact/signals';
import { Failure } from '../core/failure';
import type { AfterEdit, Pick, Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { editQueue } from '../state/edit-queue';
import { document_ } from '../state/history';
import { showMessage } from '../state/message';
import { crossHair } from '../state/store';
import { active, tool } from '../state/tool';
import { engine } from '../worker/engine';
import { addBranches } from './branches';
import { addClick, beginVessel, begunId, removeClick } from './clicks';
import { anchor, candidate, coming, drawing, drawn, first, forgetDrawing, isDrawing } from './drawing';
import { addStopper } from './stoppers';
import { checked, only, whole } from './whole-shown';

const SAME_POINT_MM = 0.05;

let beginning: Promise<AfterEdit | null> | null = null;

/** Sets a point, a stopper or a seed. Returns the value at the point, or null. */
export async function setPoint(point: Vector): Promise<Pick | null> {
  candidate.value = null;
  if (editQueue.isSearching) {
    showMessage('No point was set: the search for vessels is still running. Press Escape to stop it.');
    return null;
  }
  if (tool.value === 'stopper') {
    return (await addStopper(point))?.pick ?? null;
  }
  if (tool.value === 'seed') {
    await beginTree(point);
    return null;
  }
  if (anchor.value === null) {
    editQueue.forgetRefusal();
    batch(() => {
      checked.value = point;
      first.value = point;
    });
    return checkFirst(point);
  }
  const own = { point, drawing: drawing.value };
  coming.value = [...coming.value, own];
  const answer = await goOn(point);
  coming.value = coming.value.filter((one) => one !== own);
  return answer?.pick ?? null;
}

/** Searches branches from a seed; if none are found, the user can click again. */
async function beginTree(point: Vector): Promise<void> {
  if ((await addBranches(point)) && tool.value === 'seed') {
    tool.value = 'look';
  }
}

async function goOn(point: Vector): Promise<AfterEdit | null> {
  if (drawn.value) {
    return addClick(drawn.value.id, point);
  }
  if (beginning) {
    const id = begunId(await beginning);
    return id === null ? null : addClick(id, point);
  }
  return first.value && begin([first.value, point]);
}

async function begin(clicks: readonly [Vector, Vector]): Promise<AfterEdit | null> {
  const own = drawing.value;
  // If the user ended the vessel while it was traced, it is not extended further.
  const goesOn = () => own === drawing.value;
  beginning = beginVessel(clicks, (id) => {
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
    // If the first point caused the error, it must be set again.
    first.value = begun === null && !isBlamed(first.value) ? first.value : null;
  }
  return begun;
}

/** Checks the first point, and previews the whole vessel there. Removes the point if no vessel can begin there. */
async function checkFirst(point: Vector): Promise<Pick | null> {
  try {
    const answer = await engine.ask('first_click', { click: point, vessels: document_.value.vessels });
    whole.value = first.value === point && only.value === point ? answer.whole : whole.value;
    return answer.pick;
  } catch (error) {
    if (first.value === point) {
      first.value = null;
      editQueue.showRefusal(Failure.of(error));
    }
    return null;
  }
}

function isBlamed(point: Vector | null): boolean {
  const place = editQueue.state.refusal?.failure.place;
  return Boolean(point && place && length(subtract(place, point)) < SAME_POINT_MM);
}

/** Confirms the pending point from a projection. Returns whether there was one. */
export function acceptCandidate(): boolean {
  const point = candidate.value;
  if (point) {
    void setPoint(point);
  }
  return point !== null;
}

/** Enter confirms a pending point, or sets one at the cross-hair. Twice at one position, it ends the vessel. */
export function enter(): void {
  const place = crossHair.value?.point;
  if (acceptCandidate() || !place) {
    return;
  }
  const last = anchor.value;
  if (tool.value === 'trace' && last && isAtCrossHair(last)) {
    endVessel();
  } else {
    void setPoint(place);
  }
}

export function isAtCrossHair(place: Vector): boolean {
  const point = crossHair.value?.point;
  return point !== undefined && length(subtract(place, point)) < SAME_POINT_MM;
}

/** Ends the vessel; points still being traced are added to it. */
export function endVessel(): void {
  beginning = null;
  batch(() => {
    drawing.value += 1;
    active.value = null;
    forgetDrawing();
  });
}

/** Drops the pending point; otherwise ends the vessel; otherwise leaves the tool. Returns whether it did something. */
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

export function removeLast(): void {
  const clicks = drawn.value?.clicks;
  if (candidate.value) {
    candidate.value = null;
  } else if (drawn.value && clicks) {
    const kept = clicks.length === 2 ? (clicks[0] ?? null) : null;
    void removeClick(drawn.value.id, clicks.length - 1).then(() => {
      first.value = kept;
    });
  } else {
    first.value = null;
  }
}
