/** Lumens behind the pointer while tracing. The nearest is selected; the wheel selects others. */

import { computed, signal } from '@preact/signals';
import type { Pair, PointedAt, PointedLumen } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { engine } from '../worker/engine';
import type { ViewName } from './store';

interface UnderPointer {
  readonly view: ViewName;
  readonly at: Pair;
  readonly lumens: readonly PointedLumen[];
  readonly number: number;
}

export const pointed = signal<UnderPointer | null>(null);

export const meant = computed<PointedLumen | null>(() => pointed.value?.lumens[pointed.value.number] ?? null);

/** Finds the lumens under the pointer. Returns the selected one, or null. */
export async function lookForLumens(
  [view, at]: readonly [ViewName, Pair],
  asked: PointedAt,
): Promise<PointedLumen | null> {
  const lumens = await engine.ask('lumens', asked).catch(() => []);
  pointed.value = { view, at, lumens, number: Math.max(0, lumens.findIndex(isStillMeant)) };
  return meant.value;
}

/** Whether the selected lumen stays selected: the pointer moved little, or along the vessel. */
function isStillMeant({ center }: PointedLumen): boolean {
  const before = pointed.value?.number ? meant.value : null;
  return before !== null && length(subtract(center, before.center)) < before.diameter / 2;
}

/** Selects a deeper lumen or goes back. Returns whether there are several lumens. */
export function stepLumen(by: number): boolean {
  const now = pointed.value;
  if (!now || now.lumens.length < 2) {
    return false;
  }
  const number = Math.min(Math.max(now.number + by, 0), now.lumens.length - 1);
  pointed.value = { ...now, number };
  return true;
}

export function forgetLumens(): void {
  pointed.value = null;
}
