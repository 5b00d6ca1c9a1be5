/** Types of a session file, which the engine validates. Lengths are in mm. */
import type { Pair, SettingValue, Vector } from './plain';

export interface SavedScan {
  readonly size: Vector;
  readonly world_from_index: readonly (readonly number[])[];
}

/** A vessel without its centerline; the engine adds its confidence and its bridged parts. */
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
  readonly diameters_mm?: readonly number[];
}

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

export interface SavedSession {
  readonly scan: SavedScan | null;
  readonly vessels: readonly SavedVessel[];
  readonly doubtful: readonly SavedBranch[];
  readonly stoppers: readonly { readonly center: Vector; readonly radius_mm: number }[];
  readonly bridge: boolean;
  readonly rulers: readonly { readonly from: Vector; readonly to: Vector }[];
  /** FWHM of the point spread function entered by the user; null if it is estimated. */
  readonly fwhm_mm: number | null;
  readonly view: SavedView | null;
  /** Whether the user assumed voxels of 1 mm for a scan of unknown voxel spacing. */
  readonly one_millimetre_assumed?: boolean;
}
