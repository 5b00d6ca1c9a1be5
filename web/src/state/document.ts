/** What the user made of a scan: vessels, stoppers and marks. It is never changed in place; `history.ts` keeps what was before. */
import type { Marks, Vector, VesselDocument } from '../core/messages';

/** A straight distance between two points. */
export interface Ruler {
  readonly from: Vector;
  readonly to: Vector;
}

/** What was marked on a vessel: the same that the engine is asked with. */
export type VesselMarks = Marks;

export interface Document extends VesselDocument {
  /** By the id of the vessel. */
  readonly marks: Readonly<Record<number, VesselMarks>>;
  readonly rulers: readonly Ruler[];
  /** The reader takes the voxels of a scan that does not say how far they lie apart for 1 mm apart. */
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
