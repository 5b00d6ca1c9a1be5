/** Performs the actions of keys and buttons. Edits are in this file, other actions in `state/actions.ts`. */

import type { Action } from '../input/bindings';
import { perform } from '../state/actions';
import { redo, undo } from '../state/history';
import { crossHair, firstPlace, hasVolume, isHelpOpen, layout, problem, progress } from '../state/store';
import { tool } from '../state/tool';
import type { EngineClient } from '../worker/client';
import { addBranches } from './branches';
import { dropEdits, waiting } from './committing';
import { answerDoubt, stepDoubt } from './doubts';
import { candidate, first, target } from './drawing';
import { isListOpen } from './list-open';
import { chosenDoubt, isTracing, toggleTool } from './mode';
import { endVessel, enter, isAtCrossHair, leave, removeLast } from './pointing';
import { pickedId } from './shown';
import { remove } from './vessels';
import { takeWhole } from './whole';

export function performAny(engine: EngineClient, action: Action): void {
  const edits = hasVolume.value ? edit(engine, action) : false;
  if (!edits) {
    perform(engine, action);
  }
}

function edit(engine: EngineClient, action: Action): boolean {
  switch (action) {
    case 'trace':
      toggleTool('trace');
      return true;
    case 'vessels':
      isListOpen.value = !isListOpen.value;
      return true;
    case 'branches':
      branchesFromHere(engine);
      return true;
    case 'next doubt':
      stepDoubt(engine, 1);
      return true;
    case 'previous doubt':
      stepDoubt(engine, -1);
      return true;
    case 'accept doubt':
      void answerDoubt(engine, 'accept');
      return true;
    case 'leave doubt out':
      void answerDoubt(engine, 'leave out');
      return true;
    case 'undo':
      undoLast(engine);
      return true;
    case 'redo':
      redo();
      return true;
    case 'cancel':
      return cancelEdit(engine);
    default:
      return isTracing() ? point(engine, action) : action === 'remove' && removePicked(engine);
  }
}

function point(engine: EngineClient, action: Action): boolean {
  if (action === 'whole vessel') {
    takeWhole(engine);
  } else if (action === 'enter') {
    pressEnter(engine);
  } else if ((action === 'remove point' || action === 'remove') && tool.value === 'trace') {
    removeLast(engine);
  } else {
    return false;
  }
  return true;
}

/** Enter pressed twice at one position traces the whole vessel, if the vessel has no other point. */
function pressEnter(engine: EngineClient): void {
  const isAgain = first.value !== null && !candidate.value && isAtCrossHair(first.value);
  if (!(isAgain && takeWhole(engine))) {
    enter(engine);
  }
}

/** Deletes the picked vessel, but not while measuring or while the vessel list is closed. */
function removePicked(engine: EngineClient): boolean {
  const id = pickedId();
  if (!isListOpen.value || layout.value === 'measure' || id === null) {
    return false;
  }
  void remove(engine, [id]);
  return true;
}

/** Finds all branches from the cross-hair; if the user did not place it, the next click is the seed. */
export function branchesFromHere(engine: EngineClient): void {
  const seed = crossHair.value?.point;
  if (tool.value === 'seed' || !seed || seed === firstPlace.value) {
    toggleTool('seed');
  } else {
    endVessel();
    void addBranches(engine, seed);
  }
}

/** Stops running work; otherwise removes a pending point; otherwise undoes the last step. */
export function undoLast(engine: EngineClient): void {
  if (waiting.value > 0) {
    stopEdits(engine);
  } else if (candidate.value || first.value) {
    candidate.value = null;
    first.value = null;
  } else {
    undo();
  }
}

/** Escape: stops an edit or leaves the tool. Returns false if there is neither, or if a message must close first. */
function cancelEdit(engine: EngineClient): boolean {
  target.value = null;
  if (waiting.value > 0) {
    stopEdits(engine);
    return true;
  }
  if (problem.value || isHelpOpen.value || progress.value) {
    return false;
  }
  if (chosenDoubt.value !== null) {
    chosenDoubt.value = null;
    return true;
  }
  return leave();
}

function stopEdits(engine: EngineClient): void {
  dropEdits();
  progress.value = null;
  void engine.cancel();
}
