/** What of DICOM files is to be read. */

/** What of the files is to be read. */
export interface Wanted {
  /** The number or UID of a series. */
  readonly series: string | null;
  /** The value of an attribute that one phase has. */
  readonly phase: string | null;
  readonly fill_gaps: boolean;
  readonly resample_slices: boolean;
}

export const ALL_OF_IT: Wanted = { series: null, phase: null, fill_gaps: false, resample_slices: false };
