/**
 * Edits in turn: each is one step of the history or nothing at all. Those that need the engine show how far they are, and
 * can be stopped; where one is refused, those that wait behind it are dropped, since they were meant for what it would have made.
 */
import { signal } from '@preact/signals';
import { Failure } from '../core/failure';
import type { LineId, Progress } from '../core/messages';
import type { Tracing } from '../core/tracing';
import { placeCrossHair } from '../link/cross-hair';
import { problem, progress } from '../state/store';
import { isClicked, withLines } from './changes';
import type { Document } from './document';
import { change, document_ } from './history';
import { inNames } from './naming';

export type Edit = (document: Document) => Document;

/** An edit that was refused; it can be tried again with gaps bridged where that may help. */
export interface Refusal {
  readonly failure: Failure;
  readonly bridge: (() => void) | null;
}

/** How many edits are under way or wait. */
export const waiting = signal(0);
export const refusal = signal<Refusal | null>(null);

/** Work is shown as progress only where it takes longer than this (ms). */
const SHOWN_AFTER = 250;

let last: Promise<unknown> = Promise.resolve();
/** Which edits still count: a stop, a refusal and another study end all that are under way. */
let generation = 0;

/** Forgets all edits that are under way. */
export function dropEdits(): void {
  generation += 1;
  refusal.value = null;
}

/** What an edit does: the change that it makes in the end, of the document as it is then. */
export type Work = (document: Document, told: (progress: Progress) => void) => Promise<Edit> | Edit;

/** Does an edit when all before it are done. Says whether it was done. */
export function inTurn(words: string, work: Work, bridge: (() => void) | null = null): Promise<boolean> {
  const own = generation;
  waiting.value += 1;
  const turn = async () => {
    try {
      return own === generation && (await doEdit(words, work, own, bridge));
    } finally {
      waiting.value -= 1;
      progress.value = isOurs(progress.value) ? null : progress.value;
    }
  };
  const done = last.then(turn, turn);
  last = done;
  return done;
}

async function doEdit(words: string, work: Work, own: number, bridge: (() => void) | null): Promise<boolean> {
  forgetRefusal();
  try {
    const edit = await work(document_.value, teller(own));
    if (own !== generation) {
      return false;
    }
    change(words, edit(document_.value));
    return true;
  } catch (error) {
    if (own === generation) {
      refuse(Failure.of(error), bridge);
    }
    return false;
  }
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

function teller(own: number): (told: Progress) => void {
  const begun = performance.now();
  return (told) => {
    if (own === generation && performance.now() - begun > SHOWN_AFTER) {
      shownProgress = told;
      progress.value = told;
    }
  };
}

/** An edit that needs no tracing. */
export const commitPlain = (words: string, edit: Edit): Promise<boolean> => inTurn(words, () => edit);

/**
 * An edit of clicks, stoppers or bridges: all vessels that were clicked are traced again, beside the others. `then` is called
 * once it is done, also where that needed a bridge first.
 */
export function commit(
  tracing: Tracing,
  words: string,
  edit: Edit,
  then: () => void = () => undefined,
): Promise<boolean> {
  const work: Work = async (document, told) => {
    const lines = await traced(tracing, edit(document), told);
    return (now) => withLines(edit(now), lines);
  };
  const bridged: Edit = (document) => ({ ...edit(document), bridge: true });
  const again = () => void commit(tracing, `${words} and bridge gaps`, bridged, then);
  const done = inTurn(words, work, document_.value.bridge ? null : again);
  return done.then((isDone) => {
    if (isDone) {
      then();
    }
    return isDone;
  });
}

/** The lines of all vessels that were clicked, by the ids of the vessels. */
async function traced(
  tracing: Tracing,
  document: Document,
  told: (progress: Progress) => void,
): Promise<ReadonlyMap<number, LineId>> {
  const clicked = document.vessels.filter(isClicked);
  if (clicked.length === 0) {
    return new Map();
  }
  const beside = document.vessels.filter((vessel) => !isClicked(vessel) && vessel.doubt === null);
  const request = {
    vessels: clicked.map((vessel) => vessel.clicks),
    stoppers: document.stoppers,
    bridge: document.bridge,
    beside: beside.map((vessel) => vessel.line),
  };
  const lines = await tracing.trace(request, told).catch((error: unknown) => {
    throw inNames(Failure.of(error), clicked, document_.value);
  });
  return new Map(clicked.map((vessel, n) => [vessel.id, lines[n] ?? vessel.line]));
}
