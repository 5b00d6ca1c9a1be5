/** What judges DICOM series by their headers. */

/** The judgements of the crate `lumencut-dicom`, with JSON in and out. */
export interface Judge {
  dicom_attributes(): string;
  judge_dicom(headers: string, wanted: string): string;
}
