/** Interface of the Rust code that checks DICOM series and plans their volume. */

/** Functions of the crate `lumencut-dicom`; arguments and results are JSON. */
export interface Judge {
  dicom_attributes(): string;
  judge_dicom(headers: string, wanted: string): string;
}
