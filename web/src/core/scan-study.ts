/** The DICOM study of a scan, for objects that are saved with it. */

/** A scan from the server, which has the headers. */
export interface ServedScan {
  readonly isServed: true;
  readonly hasStudy: boolean;
}

/** A scan that the page read from files. */
export interface ReadScan {
  readonly isServed: false;
  readonly hasStudy: true;
  /** The header of one image, up to its pixels. */
  readonly header: Uint8Array<ArrayBuffer>;
  /** UIDs of its images. */
  readonly instances: readonly string[];
  /** Number of studies the images belong to. */
  readonly studyCount: number;
}

export type ScanStudy = ServedScan | ReadScan;
