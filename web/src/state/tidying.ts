/** Order of the vessel list, and facts for "Clean up": which vessels are short, thin or not connected to the picked one. */
import { computed, effect, signal } from '@preact/signals';
import { Latest } from '../core/latest';
import type { DocumentVessel, LineFacts, LineId } from '../core/messages';
import { engine } from '../worker/engine';
import { recover } from './device';
import { answered } from './edit-queue';
import { document_ } from './history';
import { isListOpen } from './panels';
import { pickedId } from './shown';

/** Vessels below these limits (mm) are marked; 0 marks none. */
export const shorterThan = signal(0);
export const thinnerThan = signal(0);

/** Whether the user wants the list as a tree; null if the user has not chosen. */
export const treeChosen = signal<boolean | null>(null);

export const highlighted = signal<number | null>(null);

export function markShorterThan(limit: number): void {
  shorterThan.value = limit;
}

export function markThinnerThan(limit: number): void {
  thinnerThan.value = limit;
}

export function markNone(): void {
  shorterThan.value = 0;
  thinnerThan.value = 0;
}

export function chooseTree(isTree: boolean): void {
  treeChosen.value = isTree;
}

export function highlight(id: number): void {
  highlighted.value = id;
}

export function endHighlight(id: number): void {
  highlighted.value = highlighted.value === id ? null : highlighted.value;
}

const facts = signal<ReadonlyMap<LineId, LineFacts>>(new Map());

/** The vessels that are not doubtful; only these can be cleaned up. */
export const sure = computed<readonly DocumentVessel[]>(() =>
  document_.value.vessels.filter((vessel) => vessel.doubt === null),
);

export const factsOf = ({ line }: DocumentVessel): LineFacts | undefined => facts.value.get(line);

/** A name for the user to confirm, if the vessel has no name or only a number. */
export const suggestedNameOf = (vessel: DocumentVessel): string | null =>
  /[^\d]$/.test(vessel.name) ? null : (factsOf(vessel)?.suggested_name ?? null);

/** The vessels that seem to be veins or parts of the heart, unless the user named them. */
export const veinsAndHeart = computed<readonly DocumentVessel[]>(() =>
  sure.value.filter((vessel) => factsOf(vessel)?.is_vein_or_heart && !/[^\d]$/.test(vessel.name)),
);

const latest = new Latest();

/** Keeps lengths and diameters of the vessels up to date while the list is open. Returns a function that stops this. */
export function followFacts(): () => void {
  return effect(() => {
    const lines = sure.value.map((vessel) => vessel.line);
    const given = answered.value?.facts ?? [];
    if (lines.length > 0 && given.map(({ line }) => line).join() === lines.join()) {
      facts.value = new Map(given.map((one) => [one.line, one]));
    } else if (isListOpen.value) {
      latest.run(() => ask(lines));
    }
  });
}

async function ask(lines: readonly LineId[]): Promise<void> {
  try {
    const found = lines.length > 0 ? await engine.ask('line_facts', { lines }) : [];
    facts.value = new Map(found.map((one) => [one.line, one]));
  } catch (error) {
    // If the study was closed meanwhile, its lines are gone.
    if (lines.every((line) => sure.value.some((vessel) => vessel.line === line))) {
      recover(error);
    }
  }
}

/** A limit slider covers this share of the vessels, so that it cannot remove all of them. */
const SLIDER_SHARE = 0.95;

/** Largest value of a limit slider: covers `SLIDER_SHARE` of the values, at most `usual`, but at least the median. */
export function reachOf(values: readonly number[], usual: number): number {
  const ordered = [...values].sort((a, b) => a - b);
  const below = (part: number) => ordered[Math.round(part * (ordered.length - 1))] ?? 0;
  return Math.min(below(SLIDER_SHARE), Math.max(usual, below(0.5)));
}

function isMarked(vessel: DocumentVessel): boolean {
  const { length = Number.POSITIVE_INFINITY, calibre = null } = factsOf(vessel) ?? {};
  return length < shorterThan.value || (calibre !== null && calibre < thinnerThan.value);
}

/** Short or thin vessels, but none that connects a longer and thicker vessel to its tree: nothing comes loose. */
export const marked = computed<ReadonlySet<number>>(() => {
  const marked = new Map(sure.value.filter(isMarked).map((vessel) => [vessel.line, vessel.id]));
  for (const kept of sure.value.filter((vessel) => !isMarked(vessel))) {
    for (let above = parentOf(kept.line); above !== null; above = parentOf(above)) {
      marked.delete(above);
    }
  }
  return new Set(marked.values());
});

const parentOf = (line: LineId): LineId | null => facts.value.get(line)?.parent ?? null;

export const unconnected = computed<readonly number[]>(() => {
  const picked = sure.value.find((vessel) => vessel.id === pickedId());
  const part = picked && factsOf(picked)?.part;
  return part === undefined
    ? []
    : sure.value.filter((vessel) => (factsOf(vessel)?.part ?? part) !== part).map((vessel) => vessel.id);
});

interface ListedVessel {
  readonly vessel: DocumentVessel;
  readonly depth: number;
}

/** Whether the list is shown as a tree; by default if some vessels are connected. */
export const isTreeShown = computed<boolean>(
  () =>
    sure.value.length > 1 &&
    (treeChosen.value ?? sure.value.some((vessel) => (factsOf(vessel)?.parent ?? null) !== null)),
);

export const listedVessels = computed<readonly ListedVessel[]>(() =>
  isTreeShown.value ? asTree(sure.value, factsOf) : sure.value.map((vessel) => ({ vessel, depth: 0 })),
);

/** The vessels in tree order; those of unknown diameter come last. */
function asTree(
  vessels: readonly DocumentVessel[],
  facts: (vessel: DocumentVessel) => LineFacts | undefined,
): readonly ListedVessel[] {
  const width = (vessel: DocumentVessel) => facts(vessel)?.calibre ?? 0;
  const widestFirst = [...vessels].sort((a, b) => width(b) - width(a));
  const under = (parent: number | null, depth: number): ListedVessel[] =>
    widestFirst
      .filter((vessel) => (facts(vessel)?.parent ?? null) === parent)
      .flatMap((vessel) => [{ vessel, depth }, ...under(vessel.line, depth + 1)]);
  return under(null, 0);
}
