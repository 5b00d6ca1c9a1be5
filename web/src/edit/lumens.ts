/** The lumens under the pointer while vessels are traced: the nearest one of a ray, or the one that the wheel has stepped to. */
import { computed, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import type { Pair, PointedAt, PointedLumen } from '../core/messages';
import { length, subtract } from '../core/vectors';
import type { ViewName } from '../state/store';

/** Where the pointer is, and which lumens are there. */
interface UnderPointer {
  readonly view: ViewName;
  readonly at: Pair;
  readonly lumens: readonly PointedLumen[];
  /** Which of them is meant. */
  readonly number: number;
}

export const pointed = signal<UnderPointer | null>(null);

/** The lumen that a click takes. */
export const meant = computed<PointedLumen | null>(() => pointed.value?.lumens[pointed.value.number] ?? null);

/** Looks for the lumens at a place of the pointer; gives the one that is meant, or null where there is none. */
export async function lookForLumens(
  engine: Asked,
  [view, at]: readonly [ViewName, Pair],
  asked: PointedAt,
): Promise<PointedLumen | null> {
  const lumens = await engine.ask('lumens', asked).catch(() => []);
  pointed.value = { view, at, lumens, number: Math.max(0, lumens.findIndex(isStillMeant)) };
  return meant.value;
}

/** Whether a lumen is the one that was stepped to: a hand that moves a little, or along the vessel, does not lose it. */
function isStillMeant({ center }: PointedLumen): boolean {
  const before = pointed.value?.number ? meant.value : null;
  return before !== null && length(subtract(center, before.center)) < before.diameter / 2;
}

/** Steps to lumens that lie deeper, or back; says whether there are several. */
export function stepLumen(by: number): boolean {
  const now = pointed.value;
  if (!now || now.lumens.length < 2) {
    return false;
  }
  const number = Math.min(Math.max(now.number + by, 0), now.lumens.length - 1);
  pointed.value = { ...now, number };
  return true;
}
