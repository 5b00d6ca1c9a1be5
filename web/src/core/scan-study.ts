/** The DICOM study of a scan, in which derived objects are saved. */

export interface ServedScan {
  readonly isServed: true;
  readonly hasStudy: boolean;
}

export interface ReadScan {
  readonly isServed: false;
  readonly hasStudy: true;
  readonly header: Uint8Array<ArrayBuffer>;
  readonly instances: readonly string[];
  readonly studyCount: number;
}

export type ScanStudy = ServedScan | ReadScan;
