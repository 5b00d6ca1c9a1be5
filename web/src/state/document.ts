/** The document: the user's vessels, stoppers and marks on a scan. It is immutable; `history.ts` keeps old versions. */
import type { Marks, Vector, VesselDocument } from '../core/messages';

export interface Ruler {
  readonly from: Vector;
  readonly to: Vector;
}

export type VesselMarks = Marks;

export interface Document extends VesselDocument {
  readonly marks: Readonly<Record<number, VesselMarks>>;
  readonly rulers: readonly Ruler[];
  /** Whether the user assumes voxels of 1 mm for a scan without voxel spacing. */
  readonly isOneMillimetre: boolean;
}

export const EMPTY: Document = {
  vessels: [],
  stoppers: [],
  bridge: false,
  bone_hidden: false,
  dark: false,
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
  confirmed: [],
};
