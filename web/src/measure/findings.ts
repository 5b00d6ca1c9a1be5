/** Findings: the vessels with marks, and the sentences that the engine writes about them. */
import { computed } from '@preact/signals';
import type { LineId, MeasuredVessel, Stated } from '../core/messages';
import { nameOf } from '../state/changes';
import type { VesselMarks } from '../state/document';
import { document_ } from '../state/history';
import { hasMillimetres } from '../state/millimetres';
import * as store from '../state/store';
import { marksOf } from './marks';

export interface Finding {
  readonly vessel: number;
  readonly line: LineId;
  readonly name: string;
  readonly length: number;
  readonly marks: VesselMarks;
}

export const isMarked = ({ at, references, stretch, secondStretch, diameters }: VesselMarks): boolean =>
  at !== null ||
  [references, diameters].some((places) => places.length > 0) ||
  (stretch ?? secondStretch) !== null;

export function findingOf(vessel: number): Finding | null {
  const shown = store.report.value?.vessels?.[vessel];
  return shown
    ? {
        vessel,
        line: shown.line,
        name: shown.name,
        length: shown.length,
        marks: marksOf(document_.value, shown.line),
      }
    : null;
}

export const listedFindings = computed<readonly Finding[]>(() =>
  (store.report.value?.vessels ?? []).flatMap((_, vessel) => {
    const finding = findingOf(vessel);
    return finding && isMarked(finding.marks) ? [finding] : [];
  }),
);

/** Names of hidden vessels with findings. They are not in the report, since they have no pictures. */
export const hiddenFindings = computed<readonly string[]>(() => {
  const { vessels, marks } = document_.value;
  return vessels.filter(({ id, isHidden }) => isHidden && marks[id] && isMarked(marks[id])).map(nameOf);
});

/** Whether lengths are in mm, and whether the orientation of the patient is known. */
export const stated = (): Stated => ({
  has_units: hasMillimetres.value,
  has_orientation: store.states.value.orientation,
});

/** The message that describes a finding to the engine; the id appears in tables. */
export const markedVessel = ({ vessel, line, name, marks }: Finding): MeasuredVessel => ({
  id: String(vessel),
  name,
  line,
  marks,
});
