/** The text of the engine about the vessel that was traced last. */
import { computed, signal } from '@preact/signals';
import type { Edited, LineId, Told } from '../core/messages';
import { vesselOf } from './changes';
import { document_ } from './history';

const last = signal<{ readonly told: Told; readonly line: LineId | undefined } | null>(null);

/** The summary of the last trace; null if nothing was traced or the vessel has changed since. */
export const tracedSummary = computed<Told | null>(() => {
  const of = last.value;
  const vessel = vesselOf(document_.value, of?.told.vessel ?? null);
  return of && vessel?.line === of.line ? of.told : null;
});

export function storeSummary({ told, document }: Edited): void {
  const line = document.vessels.find((vessel) => vessel.id === told?.vessel)?.line;
  last.value = told && { told, line };
}
