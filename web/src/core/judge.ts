/** The interface of the judge of DICOM series. */

/** Functions of the crate `lumencut-dicom`, with JSON in and out. */
export interface Judge {
  dicom_attributes(): string;
  judge_dicom(headers: string, wanted: string): string;
}
