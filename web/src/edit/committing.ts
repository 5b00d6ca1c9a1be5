/** Runs edits in sequence: each is one undo step, or fails as a whole. A failure drops the edits that wait. */
import { batch, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Failure } from '../core/failure';
import type { AfterEdit, DocumentVessel, Edit, Edited, GivenFile, Progress } from '../core/messages';
import { placeCrossHair } from '../link/cross-hair';
import { afterEdit } from '../state/changes';
import type { Document } from '../state/document';
import { change, document_ } from '../state/history';
import { problem, progress } from '../state/store';
import { storeSummary } from './traced-summary';

/** A rejected edit; `bridge` retries it with gaps bridged. */
export interface Refusal {
  readonly failure: Failure;
  readonly bridge: (() => void) | null;
}

export const waiting = signal(0);
export const refusal = signal<Refusal | null>(null);

/** Number of running searches for vessels; clicks meanwhile set no points. */
export const searches = signal(0);
const SEARCHES: readonly Edit['kind'][] = ['add_branches', 'find_vessels', 'add_mask'];

/** The last edit of the engine, even if dropped since; it saves a second request for the tree. */
export const answered = signal<AfterEdit | null>(null);

/** Progress is shown after this time (ms). */
const SHOWN_AFTER = 250;

/** A search within a vessel takes less (ms); a longer one probably started in bone, so the page asks. */
const ASKED_AFTER = 20_000;

export const isLong = signal(false);

let last: Promise<unknown> = Promise.resolve();
/** Invalidates all running edits after a stop, a rejection or a new study. */
let generation = 0;

export function dropEdits(): void {
  generation += 1;
  refusal.value = null;
}

/** Runs after all previous edits, and returns the words and the document of one undo step. */
type Work<T> = (onProgress: (progress: Progress) => void) => Promise<Step<T>> | Step<T>;

interface Step<T> {
  readonly words: string;
  readonly after: Document;
  readonly result: T;
  readonly answer?: AfterEdit;
  readonly also?: () => void;
}

/** Returns the result of the work, or null if it was not done. */
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

/** Records the step; followers receive document and answer together. */
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

/** Clears the error message when the user tries something else. */
export function forgetRefusal(): void {
  if (refusal.value && problem.value === refusal.value.failure) {
    problem.value = null;
  }
  refusal.value = null;
}

let shownProgress: Progress | null = null;
const isOurs = (now: Progress | null): boolean => now !== null && now === shownProgress;

/** Shows progress after a delay, even without further reports. */
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
  // Reports may arrive late by another channel; ignore them.
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
  /** Called with the result when the document changes, also after a gap was bridged. */
  readonly then?: (edited: Edited) => void;
  readonly bridging?: boolean;
}

/** Sends an edit of the current document to the engine. Returns null if not done. Concurrent page changes stay. */
export function commit(engine: Asked, edit: Edit, options: EditOptions = {}): Promise<AfterEdit | null> {
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
    // The engine shows its own names, so renamed vessels must be shown again.
    const edited = withNames(answer.edited, renamed);
    const after = afterEdit(document_.value, edited);
    const also = () => {
      storeSummary(edited);
      then?.(edited);
    };
    return { words: edited.words, after, result: answer, answer, also };
  };
  const again = () => void commit(engine, edit, { ...options, bridging: true });
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

/** Repeats the request if the document changed meanwhile, as by redo. */
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
