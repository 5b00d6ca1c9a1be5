/** What the engine tells of the vessel that was traced last, as long as that is what it was. */
import { computed, signal } from '@preact/signals';
import type { Edited, LineId, Told } from '../core/messages';
import { vesselOf } from '../state/changes';
import { document_ } from '../state/history';

const last = signal<{ readonly told: Told; readonly line: LineId | undefined } | null>(null);

/** Null where nothing was traced, and once the vessel is gone or runs elsewhere. */
export const told = computed<Told | null>(() => {
  const of = last.value;
  const vessel = vesselOf(document_.value, of?.told.vessel ?? null);
  return of && vessel?.line === of.line ? of.told : null;
});

/** Hears what came of an edit. */
export function hear({ told, document }: Edited): void {
  const line = document.vessels.find((vessel) => vessel.id === told?.vessel)?.line;
  last.value = told && { told, line };
}
