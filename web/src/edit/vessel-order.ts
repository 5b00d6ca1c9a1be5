/** The order of the list of vessels: as they came, or as a tree in which branches stand under what they hang on, the widest first. */
import { computed } from '@preact/signals';
import type { DocumentVessel, LineFacts } from '../core/messages';
import { treeChosen } from '../state/tidy';
import { factsOf, sure } from './tidying';

/** A row of the list. */
export interface ListedVessel {
  readonly vessel: DocumentVessel;
  /** How many others it hangs on, one on the other. */
  readonly depth: number;
}

/** Whether the list shows the vessels as a tree: by itself where some of them join. */
export const isTreeShown = computed<boolean>(
  () =>
    sure.value.length > 1 &&
    (treeChosen.value ?? sure.value.some((vessel) => (factsOf(vessel)?.parent ?? null) !== null)),
);

/** The rows of the list. */
export const listedVessels = computed<readonly ListedVessel[]>(() =>
  isTreeShown.value ? asTree(sure.value, factsOf) : sure.value.map((vessel) => ({ vessel, depth: 0 })),
);

/** Vessels as a tree; those of which nothing is known yet stand at its end. */
export function asTree(
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
