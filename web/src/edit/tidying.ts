/** Cleaning a tree: vessels that are short or thin go in one step, and so does what does not hang together with the picked one. */
import { computed, effect, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Latest } from '../core/latest';
import type { DocumentVessel, LineFacts, LineId } from '../core/messages';
import { recover } from '../state/device';
import { document_ } from '../state/history';
import { markNone, shorterThan, thinnerThan } from '../state/tidy';
import { answered } from './committing';
import { isListOpen } from './list-open';
import { pickedId } from './shown';
import { remove } from './vessels';

const facts = signal<ReadonlyMap<LineId, LineFacts>>(new Map());

/** The vessels that can be tidied: doubtful ones are accepted or left out instead. */
export const sure = computed<readonly DocumentVessel[]>(() =>
  document_.value.vessels.filter((vessel) => vessel.doubt === null),
);

export const factsOf = ({ line }: DocumentVessel): LineFacts | undefined => facts.value.get(line);

const latest = new Latest();

/** Knows the facts of the lines from now on: an edit brings them, else they are asked for while the list is open. Gives what ends it. */
export function followFacts(engine: Asked): () => void {
  return effect(() => {
    const lines = sure.value.map((vessel) => vessel.line);
    const given = answered.value?.facts ?? [];
    if (lines.length > 0 && given.map(({ line }) => line).join() === lines.join()) {
      facts.value = new Map(given.map((one) => [one.line, one]));
    } else if (isListOpen.value) {
      latest.run(() => ask(engine, lines));
    }
  });
}

async function ask(engine: Asked, lines: readonly LineId[]): Promise<void> {
  try {
    const told = lines.length > 0 ? await engine.ask('line_facts', { lines }) : [];
    facts.value = new Map(told.map((one) => [one.line, one]));
  } catch (error) {
    // Lines of a study that is closed meanwhile were forgotten.
    if (lines.every((line) => sure.value.some((vessel) => vessel.line === line))) {
      recover(error);
    }
  }
}

/** Which part of the values a slider of limits reaches: nobody removes all vessels by one. */
const MOST = 0.95;

/**
 * How far a slider of limits reaches: to what most of the values lie below, but no farther than `usual`, so that a pixel of it is
 * little; where most of them lie beyond that, to their middle.
 */
export function reachOf(values: readonly number[], usual: number): number {
  const ordered = [...values].sort((a, b) => a - b);
  const below = (part: number) => ordered[Math.round(part * (ordered.length - 1))] ?? 0;
  return Math.min(below(MOST), Math.max(usual, below(0.5)));
}

function isMarked(vessel: DocumentVessel): boolean {
  const { length = Number.POSITIVE_INFINITY, calibre = null } = factsOf(vessel) ?? {};
  return length < shorterThan.value || (calibre !== null && calibre < thinnerThan.value);
}

/** The ids of the vessels that are marked by the limits. */
export const marked = computed<ReadonlySet<number>>(
  () => new Set(sure.value.filter(isMarked).map((vessel) => vessel.id)),
);

/** The ids of the vessels that do not hang together with the picked one; none where none is picked. */
export const apart = computed<readonly number[]>(() => {
  const picked = sure.value.find((vessel) => vessel.id === pickedId());
  const part = picked && factsOf(picked)?.part;
  return part === undefined
    ? []
    : sure.value.filter((vessel) => (factsOf(vessel)?.part ?? part) !== part).map((vessel) => vessel.id);
});

/** Removes the marked vessels. */
export async function removeMarked(engine: Asked): Promise<boolean> {
  const isDone = await remove(engine, [...marked.value]);
  if (isDone) {
    markNone();
  }
  return isDone;
}

/** Keeps only what hangs together with the picked vessel. */
export const keepPart = (engine: Asked): Promise<boolean> => remove(engine, apart.value);
