/** Performs the actions of keys and buttons. Edits are in this file, other actions in `state/actions.ts`. */

import type { Action } from '../input/bindings';
import { perform } from '../state/actions';
import { showGrips } from '../state/contour';
import { aimAt, candidate, first, propose, setFirst } from '../state/drawing';
import { editQueue } from '../state/edit-queue';
import { redo, undo } from '../state/history';
import { isListOpen, toggleList } from '../state/panels';
import { escapeQuestion } from '../state/questions';
import { showLineGrips } from '../state/reshaping';
import { pickedId } from '../state/shown';
import {
  crossHair,
  firstPlace,
  hasVolume,
  isHelpOpen,
  layout,
  problem,
  progress,
  showProgress,
} from '../state/store';
import { chooseDoubt, chosenDoubt, isTracing, toggleTool, tool } from '../state/tool';
import { engine } from '../worker/engine';
import { addBranches } from './branches';
import { answerDoubt, stepDoubt } from './doubts';
import { endVessel, enter, isAtCrossHair, leave, removeLast, takeWhole } from './pointing';
import { remove } from './vessels';

export function performAny(action: Action): void {
  const edits = hasVolume.value ? edit(action) : false;
  if (!edits) {
    perform(action);
  }
}

function edit(action: Action): boolean {
  switch (action) {
    case 'trace':
      toggleTool('trace');
      return true;
    case 'vessels':
      toggleList();
      return true;
    case 'branches':
      branchesFromHere();
      return true;
    case 'next doubt':
      stepDoubt(1);
      return true;
    case 'previous doubt':
      stepDoubt(-1);
      return true;
    case 'accept doubt':
      void answerDoubt('accept');
      return true;
    case 'leave doubt out':
      void answerDoubt('leave out');
      return true;
    case 'undo':
      undoLast();
      return true;
    case 'redo':
      redo();
      return true;
    case 'cancel':
      return cancelEdit();
    default:
      return isTracing() ? point(action) : action === 'remove' && removePicked();
  }
}

function point(action: Action): boolean {
  if (action === 'whole vessel') {
    takeWhole();
  } else if (action === 'enter') {
    pressEnter();
  } else if ((action === 'remove point' || action === 'remove') && tool.value === 'trace') {
    removeLast();
  } else {
    return false;
  }
  return true;
}

/** Enter pressed twice at one position traces the whole vessel, if the vessel has no other point. */
function pressEnter(): void {
  const isAgain = first.value !== null && !candidate.value && isAtCrossHair(first.value);
  if (!(isAgain && takeWhole())) {
    enter();
  }
}

/** Deletes the picked vessel, but not while measuring or while the vessel list is closed. */
function removePicked(): boolean {
  const id = pickedId();
  if (!isListOpen.value || layout.value === 'measure' || id === null) {
    return false;
  }
  void remove([id]);
  return true;
}

/** Finds all branches from the cross-hair; if the user did not place it, the next click is the seed. */
export function branchesFromHere(): void {
  const seed = crossHair.value?.point;
  if (tool.value === 'seed' || !seed || seed === firstPlace.value) {
    toggleTool('seed');
  } else {
    endVessel();
    void addBranches(seed);
  }
}

/** Stops running work; otherwise removes a pending point; otherwise undoes the last step. */
export function undoLast(): void {
  if (editQueue.isBusy) {
    stopEdits();
  } else if (candidate.value || first.value) {
    propose(null);
    setFirst(null);
  } else {
    undo();
  }
}

/** Escape: answers a question, stops an edit or leaves the tool. Returns false if there is neither, or if a message must close first. */
function cancelEdit(): boolean {
  if (escapeQuestion()) {
    return true;
  }
  aimAt(null);
  if (showGrips(false) || showLineGrips(false)) {
    return true;
  }
  if (editQueue.isBusy) {
    stopEdits();
    return true;
  }
  if (problem.value || isHelpOpen.value || progress.value) {
    return false;
  }
  if (chosenDoubt.value !== null) {
    chooseDoubt(null);
    return true;
  }
  return leave();
}

function stopEdits(): void {
  editQueue.drop();
  showProgress(null);
  void engine.cancel();
}
