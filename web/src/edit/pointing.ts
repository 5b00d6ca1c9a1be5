/** Clicks, Enter and Escape in the tracing tools. */

import { Failure } from '../core/failure';
import type { Edited } from '../core/generated/questions';
import type { AfterEdit, Pick, Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { jumpTo, moveCrossHair } from '../state/cross-hair';
import {
  addComing,
  anchor,
  candidate,
  drawing,
  drawn,
  endDrawing,
  extendBegun,
  first,
  isDrawing,
  only,
  propose,
  setCheckedFirst,
  setFirst,
  showWhole,
} from '../state/drawing';
import { editQueue, isGap } from '../state/edit-queue';
import { document_ } from '../state/history';
import { showMessage } from '../state/message';
import { pickWhenShown } from '../state/shown';
import { crossHair } from '../state/store';
import { takeTool, tool } from '../state/tool';
import { engine } from '../worker/engine';
import { addBranches } from './branches';
import { addClick, addStopper, beginVessel, begunId, removeClick } from './clicks';
import { commit } from './committing';

const SAME_POINT_MM = 0.05;

let beginning: Promise<AfterEdit | null> | null = null;

/** Sets a point, a stopper or a seed. Returns the value at the point, or null. */
export async function setPoint(point: Vector): Promise<Pick | null> {
  propose(null);
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
    setCheckedFirst(point);
    return checkFirst(point);
  }
  const end = addComing(point);
  const answer = await goOn(point);
  end();
  return answer?.pick ?? null;
}

/** Searches branches from a seed; if none are found, the user can click again. */
async function beginTree(point: Vector): Promise<void> {
  if ((await addBranches(point)) && tool.value === 'seed') {
    takeTool('look');
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
      extendBegun(id);
    }
  });
  const begun = await beginning;
  if (goesOn()) {
    beginning = null;
    // If the first point caused the error, it must be set again.
    if (begun === null && isBad(clicks[0])) {
      // The newer click takes the place of the bad one, so that the next click need not be a second try.
      suspect = null;
      jumpTo(clicks[1]);
      setCheckedFirst(clicks[1]);
      void checkFirst(clicks[1]);
    } else {
      setFirst(begun === null ? clicks[0] : null);
    }
  }
  return begun;
}

/** A first point at which no whole vessel was found. */
let suspect: Vector | null = null;

/** Whether the first of two points caused the error: it is blamed, or no vessel was found there before. */
function isBad(point: Vector): boolean {
  return isBlamed(point) || (suspect === point && !isGap(editQueue.state.refusal?.failure));
}

/** Checks the first point, and previews the whole vessel there. Removes the point if no vessel can begin there. */
async function checkFirst(point: Vector): Promise<Pick | null> {
  try {
    const answer = await engine.ask('first_click', { click: point, vessels: document_.value.vessels });
    if (first.value === point) {
      showWhole(answer.whole, point);
    }
    return answer.pick;
  } catch (error) {
    if (first.value === point) {
      setFirst(null);
      editQueue.showRefusal(Failure.of(error));
    }
    return null;
  }
}

function isBlamed(point: Vector | null): boolean {
  const place = editQueue.state.refusal?.failure.place;
  return Boolean(point && place && length(subtract(place, point)) < SAME_POINT_MM);
}

/** Sets the point at the nearest place that looks like lumen. */
export function takeNearest(place: Vector): void {
  editQueue.forgetRefusal();
  jumpTo(place);
  void setPoint(place);
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
  endDrawing();
}

/** Drops the pending point; otherwise ends the vessel; otherwise leaves the tool. Returns whether it did something. */
export function leave(): boolean {
  if (tool.value === 'look') {
    return false;
  }
  if (candidate.value) {
    propose(null);
  } else if (isDrawing.value) {
    endVessel();
  } else {
    takeTool('look');
  }
  return true;
}

export function removeLast(): void {
  const clicks = drawn.value?.clicks;
  if (candidate.value) {
    propose(null);
  } else if (drawn.value && clicks) {
    const kept = clicks.length === 2 ? (clicks[0] ?? null) : null;
    void removeClick(drawn.value.id, clicks.length - 1).then(() => {
      setFirst(kept);
    });
  } else {
    setFirst(null);
  }
}

/** Traces the whole vessel at one clicked point. Returns whether there was one. It stays if a second point could help. */
export function takeWhole(): boolean {
  const click = only.value;
  if (click) {
    endVessel();
    const then = ({ added: [id] }: Edited) => pickWhenShown(id);
    void commit({ kind: 'add_whole_vessel', click }, { then }).then((answer) => {
      if (answer !== null || isDrawing.value || tool.value !== 'trace') {
        return;
      }
      if (editQueue.state.refusal?.failure.advice === '') {
        // The vessel is there already: it is picked.
        moveCrossHair(click, 'turning');
      } else {
        suspect = click;
        setFirst(click);
      }
    });
  }
  return click !== null;
}
