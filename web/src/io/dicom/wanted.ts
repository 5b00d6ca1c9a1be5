/** Choices of the user when DICOM files are read. */

export interface Wanted {
  readonly series: string | null;
  /** Value of the DICOM attribute that distinguishes the phases; null if not chosen. */
  readonly phase: string | null;
  readonly fill_gaps: boolean;
  readonly resample_slices: boolean;
}

export const ALL_OF_IT: Wanted = { series: null, phase: null, fill_gaps: false, resample_slices: false };
