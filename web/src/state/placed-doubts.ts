import { computed } from '@preact/signals';
import type { DocumentVessel, VesselDoubt } from '../core/messages';
import { tree } from './shown';
import { vesselDoubts } from './store';

export interface PlacedDoubt extends VesselDoubt {
  readonly vessel: DocumentVessel;
}

/** Doubts about lines that are no longer shown are left out; the most frequent kind comes first. */
export const placedDoubts = computed<readonly (readonly [kind: string, readonly PlacedDoubt[]])[]>(() => {
  const vesselOf = new Map(tree.value.map((vessel) => [vessel.line, vessel]));
  const kinds = new Map<string, PlacedDoubt[]>();
  for (const doubt of vesselDoubts.value) {
    const vessel = vesselOf.get(doubt.line);
    if (vessel !== undefined) {
      kinds.set(doubt.kind, [...(kinds.get(doubt.kind) ?? []), { ...doubt, vessel }]);
    }
  }
  return [...kinds].sort(([, a], [, b]) => b.length - a.length);
});
