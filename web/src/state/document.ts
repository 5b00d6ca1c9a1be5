/** The user's work on a scan: vessels, stoppers and marks. Immutable; `history.ts` keeps earlier versions. */
import type { Marks, Vector, VesselDocument } from '../core/messages';

export interface Ruler {
  readonly from: Vector;
  readonly to: Vector;
}

export type VesselMarks = Marks;

export interface Document extends VesselDocument {
  readonly marks: Readonly<Record<number, VesselMarks>>;
  readonly rulers: readonly Ruler[];
  /** The user assumes 1 mm for a scan without voxel spacing. */
  readonly isOneMillimetre: boolean;
}

export const EMPTY: Document = {
  vessels: [],
  stoppers: [],
  bridge: false,
  marks: {},
  rulers: [],
  isOneMillimetre: false,
};

export const NO_MARKS: VesselMarks = {
  at: null,
  references: [],
  method: 'nascet',
  original: null,
  comparison: null,
  group: null,
  stretch: null,
  secondStretch: null,
  diameters: [],
};
