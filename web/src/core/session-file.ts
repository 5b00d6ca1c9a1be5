/** What page and worker tell each other of session files. The fields are those of the file, which the module checks; lengths in mm. */
import type { Pair, SettingValue, Vector } from './plain';

/** The grid of the scan that a session was made of. */
export interface SavedScan {
  readonly size: Vector;
  readonly world_from_index: readonly (readonly number[])[];
}

/** What belongs to a vessel beside its line; the module adds confidence and what was bridged. */
export interface SavedVessel {
  readonly color: string;
  readonly hidden: boolean;
  readonly clicks: readonly Vector[] | null;
  readonly marks: SavedMarks | null;
}

export interface SavedMarks {
  readonly at_mm: number | null;
  readonly references_mm: readonly number[];
  readonly method: string;
  readonly original_mm: number | null;
  readonly comparison_mm: number | null;
  readonly group: string | null;
  readonly stretch_mm: Pair | null;
  readonly second_stretch_mm: Pair | null;
  /** Left out where there are none. */
  readonly diameters_mm?: readonly number[];
}

/** A branch that nobody has accepted yet, without its line. */
export interface SavedBranch {
  readonly color: string;
  readonly doubt: string;
}

export interface SavedView {
  readonly camera: {
    readonly center: Vector;
    readonly direction: Vector;
    readonly up: Vector;
    readonly size: Pair;
    readonly pixel_spacing: number;
  };
  readonly method: string;
  readonly settings: Readonly<Record<string, SettingValue>>;
  readonly layout: string;
  readonly cross_hair: Vector | null;
  readonly picked: { readonly vessel: number; readonly at_mm: number } | null;
}

/** All of a session but its lines. */
export interface SavedSession {
  readonly scan: SavedScan | null;
  readonly vessels: readonly SavedVessel[];
  readonly doubtful: readonly SavedBranch[];
  readonly stoppers: readonly { readonly center: Vector; readonly radius_mm: number }[];
  readonly bridge: boolean;
  readonly rulers: readonly { readonly from: Vector; readonly to: Vector }[];
  /** The width of the point spread that the reader gave; null where it is estimated. */
  readonly fwhm_mm: number | null;
  readonly view: SavedView | null;
  /** Whether voxels were taken for 1 mm apart where the scan does not say; a file that leaves it out says no. */
  readonly one_millimetre_assumed?: boolean;
}
