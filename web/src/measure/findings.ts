/** The findings of the scan: the vessels on which a reader marked something, with what is told of them. */
import { computed, signal } from '@preact/signals';
import type { Findings, LineId, MeasuredVessel, Stated } from '../core/messages';
import { nameOf } from '../state/changes';
import type { VesselMarks } from '../state/document';
import { document_ } from '../state/history';
import { hasMillimetres } from '../state/millimetres';
import * as store from '../state/store';
import { marksOf } from './vessels';

/** A vessel with a finding. */
export interface Finding {
  /** Its number in the tree that is shown. */
  readonly vessel: number;
  readonly line: LineId;
  /** Its name; empty where it has none. */
  readonly name: string;
  /** mm */
  readonly length: number;
  readonly marks: VesselMarks;
}

/** Whether a reader marked anything on a vessel. */
export const isMarked = ({ at, references, stretch, secondStretch, diameters }: VesselMarks): boolean =>
  at !== null ||
  [references, diameters].some((places) => places.length > 0) ||
  (stretch ?? secondStretch) !== null;

/** A vessel of the tree that is shown, with its marks. */
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

/** The findings on the vessels that are shown, in the order of the list. */
export const listedFindings = computed<readonly Finding[]>(() =>
  (store.report.value?.vessels ?? []).flatMap((_, vessel) => {
    const finding = findingOf(vessel);
    return finding && isMarked(finding.marks) ? [finding] : [];
  }),
);

/** The names of the vessels with findings that are hidden: no picture can be made of them. */
export const hiddenFindings = computed<readonly string[]>(() => {
  const { vessels, marks } = document_.value;
  return vessels.filter(({ id, isHidden }) => isHidden && marks[id] && isMarked(marks[id])).map(nameOf);
});

/** The lines of findings that the report leaves out. */
export const leftOut = signal<ReadonlySet<LineId>>(new Set());

/** Leaves a finding out of the report, or takes it in again. */
export function leaveOut(line: LineId, isOut: boolean): void {
  const others = [...leftOut.value].filter((other) => other !== line);
  leftOut.value = new Set(isOut ? [...others, line] : others);
}

/** What the engine says of the findings; null before it said so. */
export const toldFindings = signal<Findings | null>(null);

/** Another study has findings of its own. */
export function forgetFindings(): void {
  leftOut.value = new Set();
  toldFindings.value = null;
}

/** What is known of the scan's grid, as reports and findings are told. */
export const stated = (): Stated => ({
  has_units: hasMillimetres.value,
  has_orientation: store.states.value.orientation,
});

/** A finding as the engine is asked for it; its id is the number that it has in tables. */
export const markedVessel = ({ vessel, line, name, marks }: Finding): MeasuredVessel => ({
  id: String(vessel),
  name,
  line,
  marks,
});
