/** What is known of the study of DICOM that a scan belongs to, for objects that are put beside it. */

/** The scan of the server: it has the headers itself. */
export interface ServedScan {
  readonly isServed: true;
  /** Whether the scan was read from DICOM. */
  readonly hasStudy: boolean;
}

/** A scan whose files the page read. */
export interface ReadScan {
  readonly isServed: false;
  readonly hasStudy: true;
  /** What stands before the pixels of one image. */
  readonly header: Uint8Array<ArrayBuffer>;
  /** The UIDs of its images. */
  readonly instances: readonly string[];
  /** How many studies they belong to. */
  readonly studyCount: number;
}

export type ScanStudy = ServedScan | ReadScan;
