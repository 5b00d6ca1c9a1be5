/**
 * Edits in turn: each is one step of the history or nothing at all. Those that need the engine show how far they are, and
 * can be stopped; where one is refused, those that wait behind it are dropped, since they were meant for what it would have made.
 */
import { batch, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Failure } from '../core/failure';
import type { AfterEdit, DocumentVessel, Edit, Edited, GivenFile, Progress } from '../core/messages';
import { placeCrossHair } from '../link/cross-hair';
import { afterEdit } from '../state/changes';
import type { Document } from '../state/document';
import { change, document_ } from '../state/history';
import { problem, progress } from '../state/store';
import { hear } from './telling';

/** An edit that was refused; it can be tried again with gaps bridged where that may help. */
export interface Refusal {
  readonly failure: Failure;
  readonly bridge: (() => void) | null;
}

/** How many edits are under way or wait. */
export const waiting = signal(0);
export const refusal = signal<Refusal | null>(null);

/** How many edits under way look for many vessels: clicks meanwhile are no points of others. */
export const searches = signal(0);
const SEARCHES: readonly Edit['kind'][] = ['add_branches', 'find_vessels', 'add_mask'];

/**
 * What came of the last edit that the engine made, and what it shows since: it is taken from here, so that nothing more is asked. Also
 * of one that was dropped meanwhile, after which the engine shows another tree than the document has.
 */
export const answered = signal<AfterEdit | null>(null);

/** Work is shown as progress only where it takes longer than this (ms). */
const SHOWN_AFTER = 250;

/** Branches from a place within a vessel are found sooner than this (ms): the reader is asked whether that is where the place lies. */
const ASKED_AFTER = 20_000;

/** Whether the edit under way takes so long that the reader is asked. */
export const isLong = signal(false);

let last: Promise<unknown> = Promise.resolve();
/** Which edits still count: a stop, a refusal and another study end all that are under way. */
let generation = 0;

/** Forgets all edits that are under way. */
export function dropEdits(): void {
  generation += 1;
  refusal.value = null;
}

/** Does work when all before it is done: it gives the words of a step and the document after it, of which it makes a step. */
type Work<T> = (told: (progress: Progress) => void) => Promise<Step<T>> | Step<T>;

interface Step<T> {
  readonly words: string;
  readonly after: Document;
  readonly result: T;
  /** What the engine answered; none of a change of the page's own. */
  readonly answer?: AfterEdit;
  /** Changes what goes with the document. */
  readonly also?: () => void;
}

/** Gives what came of the work; null where it was not done. */
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
  const tell = teller(own);
  try {
    const step = await work(tell.told);
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
    tell.end();
  }
}

/** Makes a step of what was done; whatever follows the document hears of it and of the answer at once. */
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
    tellRefusal(failure, isGap(failure) ? bridge : null);
  }
}

/** Tells what was refused, and shows its place in all views. */
export function tellRefusal(failure: Failure, bridge: (() => void) | null = null): void {
  refusal.value = { failure, bridge };
  problem.value = failure;
  if (failure.place) {
    const { place: point, value } = failure;
    placeCrossHair({ point, value, vessel: null, arc_length: null }, 'turning');
  }
}

/** Whether a stretch without lumen was refused, which can be bridged. */
export const isGap = (failure: Failure): boolean => failure.isMendedBy('bridge');

/** What was refused is no longer told once something else is tried. */
export function forgetRefusal(): void {
  if (refusal.value && problem.value === refusal.value.failure) {
    problem.value = null;
  }
  refusal.value = null;
}

let shownProgress: Progress | null = null;
const isOurs = (told: Progress | null): boolean => told !== null && told === shownProgress;

/** Shows how far an edit is, from a moment after its begin to its end: also where nothing new is told of it then. */
function teller(own: number): { told: (progress: Progress) => void; end: () => void } {
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
  const told = (heard: Progress) => {
    newest = heard;
    show();
  };
  // What is heard after the end, on a way of its own, is no longer shown.
  const end = () => {
    clearTimeout(timer);
    isDue = false;
  };
  return { told, end };
}

/** A change of the page's own, of the document as it is in its turn. */
export function commitPlain(words: string, edit: (document: Document) => Document): Promise<boolean> {
  return isDone(inTurn(() => ({ words, after: edit(document_.value), result: words }), null));
}

/** What comes with an edit. */
interface Beside {
  /** The files of a mask that is added. */
  readonly mask?: readonly GivenFile[];
  /** Changes the vessels that came to the document. */
  readonly renamed?: (vessel: DocumentVessel) => DocumentVessel;
  /** Hears what came of it together with the document, also where that needed a bridge first. */
  readonly then?: (edited: Edited) => void;
  readonly bridging?: boolean;
}

/**
 * An edit of vessels, which the engine makes of the document as it is in its turn; gives what came of it, null where it was not
 * done. What the page changes meanwhile, such as marks, stays.
 */
export function commit(engine: Asked, edit: Edit, beside: Beside = {}): Promise<AfterEdit | null> {
  const { mask, then, renamed = (vessel) => vessel, bridging = false } = beside;
  const files = mask && { mask };
  const work: Work<AfterEdit> = async (told) => {
    const ask = ({ vessels, stoppers, bridge }: Document) =>
      engine.ask('edit', { document: { vessels, stoppers, bridge }, edit, bridging }, { told, ...files });
    const answer = await latest(ask);
    // The engine shows the names that it gave: where others are given here, it is asked to show those.
    const edited = withNames(answer.edited, renamed);
    const after = afterEdit(document_.value, edited);
    const also = () => {
      hear(edited);
      then?.(edited);
    };
    return { words: edited.words, after, result: answer, answer, also };
  };
  const again = () => void commit(engine, edit, { ...beside, bridging: true });
  const found = SEARCHES.includes(edit.kind) ? counted(work) : work;
  return inTurn(edit.kind === 'add_branches' ? askedAbout(found) : found, again);
}

/** Work that counts among the searches while it is under way. */
function counted<T>(work: Work<T>): Work<T> {
  return async (told) => {
    searches.value += 1;
    try {
      return await work(told);
    } finally {
      searches.value -= 1;
    }
  };
}

/** What came of an edit, with other names of the vessels that came. */
function withNames(edited: Edited, renamed: (vessel: DocumentVessel) => DocumentVessel): Edited {
  const { document, added } = edited;
  const vessels = document.vessels.map((one) => (added.includes(one.id) ? renamed(one) : one));
  return { ...edited, document: { ...document, vessels } };
}

/** Work about which the reader is asked where it takes long. */
function askedAbout<T>(work: Work<T>): Work<T> {
  return async (told) => {
    const timer = setTimeout(() => {
      isLong.value = true;
    }, ASKED_AFTER);
    try {
      return await work(told);
    } finally {
      clearTimeout(timer);
      isLong.value = false;
    }
  };
}

/** What comes of an edit of the vessels that there are when it comes: it is asked for again after a redo meanwhile. */
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

/** Whether an edit was done. */
export const isDone = (edit: Promise<unknown>): Promise<boolean> => edit.then((result) => result !== null);
