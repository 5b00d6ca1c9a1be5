/** Types of messages between page and worker. Those of the engine are generated (`generated/questions.ts`). */
import type {
  DoubtRow,
  LookRow,
  Picture,
  Questions,
  RegionRow,
  ScanIdentity,
  SettingRow,
} from './generated/questions';
import type { SAVED_CENTERLINES } from './generated/tables';

export type * from './generated/questions';
export type * from './plain';

export type CenterlineKind = (typeof SAVED_CENTERLINES)[number];

/** Whether the file states spacing and orientation; otherwise the page shows no mm and no patient sides. */
export interface States {
  readonly spacing: boolean;
  readonly orientation: boolean;
}

export interface GivenFile {
  readonly path: string;
  readonly file: File;
}

/** Choices of the user for opening files that are ambiguous. */
export interface SeriesWish {
  /** Series number or series instance UID. */
  readonly series?: string;
  /** Value of the DICOM attribute that distinguishes the phases. */
  readonly phase?: string;
  readonly fill_gaps?: boolean;
  readonly resample_slices?: boolean;
  readonly coordinates?: string;
  readonly unit?: string;
  readonly reorder?: boolean;
  /** Loads every second voxel along each axis, to save memory. */
  readonly every_second?: boolean;
}

/** A rendered view: its pixels, or none if the worker drew them on the canvas. */
export interface Drawn {
  readonly picture: Picture | null;
  readonly milliseconds: number;
}

/** Progress of long work; `total` is null if unknown. */
export interface Progress {
  readonly words: string;
  readonly done: number;
  readonly total: number | null;
}

export interface Started {
  readonly device: string;
  readonly isGpu: boolean;
  readonly threads: number;
  readonly isIsolated: boolean;
  readonly table: readonly SettingRow[];
  readonly looks: readonly LookRow[];
  readonly regions: readonly RegionRow[];
  readonly doubts: readonly DoubtRow[];
  /** The shared byte through which the page stops the worker; null without shared memory. */
  readonly stop: { readonly buffer: SharedArrayBuffer; readonly address: number } | null;
}

export type Question = keyof Questions;
export type Message<N extends Question> = Questions[N]['message'];
export type Answer<N extends Question> = Questions[N]['answer'];

export type OnProgress = (progress: Progress) => void;

export interface Attachments {
  readonly onProgress?: OnProgress;
  readonly bytes?: Uint8Array;
  /** Files of a vessel mask; the worker reads them before it runs the edit. */
  readonly mask?: readonly GivenFile[];
}

/** Requests to the engine, also implemented by test doubles. */
export interface Asked {
  /** Answers a request listed in `generated/questions.ts`. Throws `Failure`. */
  ask<N extends Question>(name: N, message: Message<N>, attachments?: Attachments): Promise<Answer<N>>;
}

/** A scan that the server of the page holds. Derived objects are saved in its DICOM study. */
export interface ServedScan {
  readonly isServed: true;
  readonly hasStudy: boolean;
  readonly identity: ScanIdentity | null;
}

export interface ReadScan {
  readonly isServed: false;
  readonly hasStudy: true;
  readonly header: Uint8Array<ArrayBuffer>;
  readonly instances: readonly string[];
  readonly studyCount: number;
  readonly identity: ScanIdentity;
}

export type ScanStudy = ServedScan | ReadScan;
