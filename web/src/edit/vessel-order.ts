/** Order of the vessel list: as added, or as a tree with the widest branches first. */
import { computed } from '@preact/signals';
import type { DocumentVessel, LineFacts } from '../core/messages';
import { factsOf, sure, treeChosen } from '../state/tidying';

export interface ListedVessel {
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
