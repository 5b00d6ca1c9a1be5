/** Runs edits one after another. Each becomes one undo step or changes nothing; a failure drops all waiting edits. */

import { batch, signal } from '@preact/signals';
import { Failure } from '../core/failure';
import type { AfterEdit, DocumentVessel, Edit, Edited, GivenFile, Progress } from '../core/messages';
import { afterEdit } from '../state/changes';
import { placeCrossHair } from '../state/cross-hair';
import type { Document } from '../state/document';
import { change, document_ } from '../state/history';
import { problem, progress } from '../state/store';
import { engine } from '../worker/engine';
import { storeSummary } from './traced-summary';

/** A rejected edit; `bridge` repeats it and bridges gaps. */
export interface Refusal {
  readonly failure: Failure;
  readonly bridge: (() => void) | null;
}

export const waiting = signal(0);
export const refusal = signal<Refusal | null>(null);

/** Number of running searches for vessels. During a search, clicks set no points. */
export const searches = signal(0);
const SEARCHES: readonly Edit['kind'][] = ['add_branches', 'find_vessels', 'add_mask'];

/** The latest answer to an edit. It contains the tree, so the page need not request it again. */
export const answered = signal<AfterEdit | null>(null);

/** The progress of an edit is shown only if the edit takes longer than this (ms). */
const SHOWN_AFTER = 250;

/** A longer search (ms) probably started in bone instead of a vessel, so the page asks the user. */
const ASKED_AFTER = 20_000;

export const isLong = signal(false);

let last: Promise<unknown> = Promise.resolve();
/** Incremented by a stop, a rejection or a new study; results of edits that began earlier are ignored. */
let generation = 0;

export function dropEdits(): void {
  generation += 1;
  refusal.value = null;
}

/** The work of an edit. It returns the description and the new document of one undo step. */
type Work<T> = (onProgress: (progress: Progress) => void) => Promise<Step<T>> | Step<T>;

interface Step<T> {
  readonly words: string;
  readonly after: Document;
  readonly result: T;
  readonly answer?: AfterEdit;
  readonly also?: () => void;
}

/** Runs the work after all previous edits. Returns its result, or null if it was not done. */
function inTurn<T>(work: Work<T>, bridge: (() => void) | null): Promise<T | null> {
  const own = generation;
  waiting.value += 1;
  const turn = async () => {
    try {
      return own === generation ? await doEdit(work, own, bridge) : null;
    } finally {
      waiting.value -= 1;
      progress.value = isOurs(progress.value) ? null : progress.value;
    }
  };
  const done = last.then(turn, turn);
  last = done;
  return done;
}

async function doEdit<T>(work: Work<T>, own: number, bridge: (() => void) | null): Promise<T | null> {
  forgetRefusal();
  const display = progressDisplay(own);
  try {
    const step = await work(display.onProgress);
    if (own !== generation) {
      answered.value = step.answer ?? answered.value;
      return null;
    }
    take(step);
    return step.result;
  } catch (error) {
    if (own === generation) {
      refuse(Failure.of(error), bridge);
    }
    return null;
  } finally {
    display.end();
  }
}

/** Records the undo step; updates document and answer together. */
function take({ words, after, answer, also }: Step<unknown>): void {
  batch(() => {
    answered.value = answer ?? answered.value;
    change(words, after);
    also?.();
  });
}

function refuse(failure: Failure, bridge: (() => void) | null): void {
  generation += 1;
  if (failure.kind !== 'interrupted') {
    showRefusal(failure, isGap(failure) ? bridge : null);
  }
}

export function showRefusal(failure: Failure, bridge: (() => void) | null = null): void {
  refusal.value = { failure, bridge };
  problem.value = failure;
  if (failure.place) {
    const { place: point, value } = failure;
    placeCrossHair({ point, value, vessel: null, arc_length: null }, 'turning');
  }
}

export const isGap = (failure: Failure): boolean => failure.isMendedBy('bridge');

/** Closes the error message of a rejected edit when the user tries something else. */
export function forgetRefusal(): void {
  if (refusal.value && problem.value === refusal.value.failure) {
    problem.value = null;
  }
  refusal.value = null;
}

let shownProgress: Progress | null = null;
const isOurs = (now: Progress | null): boolean => now !== null && now === shownProgress;

/** Shows the progress of an edit after a delay, even if no progress was reported. */
function progressDisplay(own: number): { onProgress: (progress: Progress) => void; end: () => void } {
  let newest: Progress | null = null;
  let isDue = false;
  const show = () => {
    if (own === generation && isDue && newest) {
      shownProgress = newest;
      progress.value = newest;
    }
  };
  const begin = () => {
    isDue = true;
    show();
  };
  const timer = setTimeout(begin, SHOWN_AFTER);
  const onProgress = (report: Progress) => {
    newest = report;
    show();
  };
  // Progress reports may arrive after the edit has ended; ignore them.
  const end = () => {
    clearTimeout(timer);
    isDue = false;
  };
  return { onProgress, end };
}

export function commitPlain(words: string, edit: (document: Document) => Document): Promise<boolean> {
  return isDone(inTurn(() => ({ words, after: edit(document_.value), result: words }), null));
}

interface EditOptions {
  readonly mask?: readonly GivenFile[];
  readonly renamed?: (vessel: DocumentVessel) => DocumentVessel;
  /** Called when the edit has changed the document, also if the user first bridged a gap. */
  readonly then?: (edited: Edited) => void;
  readonly bridging?: boolean;
}

/** Sends an edit to the engine; returns null if it was not done. Changes made in the page meanwhile are kept. */
export function commit(edit: Edit, options: EditOptions = {}): Promise<AfterEdit | null> {
  const { mask, then, renamed = (vessel) => vessel, bridging = false } = options;
  const files = mask && { mask };
  const work: Work<AfterEdit> = async (onProgress) => {
    const ask = ({ vessels, stoppers, bridge }: Document) =>
      engine.ask(
        'edit',
        { document: { vessels, stoppers, bridge }, edit, bridging },
        { onProgress, ...files },
      );
    const answer = await latest(ask);
    // The engine displays the vessel names that it knows, so renamed vessels must be displayed again.
    const edited = withNames(answer.edited, renamed);
    const after = afterEdit(document_.value, edited);
    const also = () => {
      storeSummary(edited);
      then?.(edited);
    };
    return { words: edited.words, after, result: answer, answer, also };
  };
  const again = () => void commit(edit, { ...options, bridging: true });
  const found = SEARCHES.includes(edit.kind) ? counted(work) : work;
  return inTurn(edit.kind === 'add_branches' ? askedAbout(found) : found, again);
}

function counted<T>(work: Work<T>): Work<T> {
  return async (onProgress) => {
    searches.value += 1;
    try {
      return await work(onProgress);
    } finally {
      searches.value -= 1;
    }
  };
}

function withNames(edited: Edited, renamed: (vessel: DocumentVessel) => DocumentVessel): Edited {
  const { document, added } = edited;
  const vessels = document.vessels.map((one) => (added.includes(one.id) ? renamed(one) : one));
  return { ...edited, document: { ...document, vessels } };
}

function askedAbout<T>(work: Work<T>): Work<T> {
  return async (onProgress) => {
    const timer = setTimeout(() => {
      isLong.value = true;
    }, ASKED_AFTER);
    try {
      return await work(onProgress);
    } finally {
      clearTimeout(timer);
      isLong.value = false;
    }
  };
}

/** Repeats the request if the document changed meanwhile, for example by redo. */
async function latest(ask: (document: Document) => Promise<AfterEdit>): Promise<AfterEdit> {
  for (;;) {
    const before = document_.value;
    const answer = await ask(before);
    const now = document_.value;
    if (now.vessels === before.vessels && now.stoppers === before.stoppers && now.bridge === before.bridge) {
      return answer;
    }
    answered.value = answer;
  }
}

export const isDone = (edit: Promise<unknown>): Promise<boolean> => edit.then((result) => result !== null);
