/** What the page and its worker tell each other. What the engine is asked and answers is written of its own table of questions. */
import type { DoubtRow, LookRow, Picture, RegionRow, SettingRow } from './generated/questions';

export type * from './generated/questions';
export type * from './plain';

export type CenterlineKind = 'vtp' | 'mrk.json';

/** What a file says of its grid: without it no lengths in mm, and no sides of the patient, are shown. */
export interface States {
  readonly spacing: boolean;
  readonly orientation: boolean;
}

/** A file that was dropped or chosen, with the folders that it came with. */
export interface GivenFile {
  readonly path: string;
  readonly file: File;
}

/** How a study is to be read, where that is not clear. */
export interface SeriesWish {
  /** The number or UID of a series. */
  readonly series?: string;
  /** The value of an attribute that one phase has. */
  readonly phase?: string;
  readonly fill_gaps?: boolean;
  readonly resample_slices?: boolean;
  /** The space of centerlines. */
  readonly coordinates?: string;
  /** The unit of centerlines. */
  readonly unit?: string;
  /** Whether the points of centerlines are put into their order. */
  readonly reorder?: boolean;
  /** Every second voxel along each axis alone: where there is no memory for all of them. */
  readonly every_second?: boolean;
}

/** What came of a view: its pixels, or nothing where the worker drew it on the canvas. */
export interface Drawn {
  readonly picture: Picture | null;
  readonly milliseconds: number;
}

/** How far long work is; without a total it is not known how much there is. */
export interface Progress {
  readonly words: string;
  readonly done: number;
  readonly total: number | null;
}

/** What computes. */
export interface Started {
  readonly device: string;
  readonly isGpu: boolean;
  readonly threads: number;
  readonly isIsolated: boolean;
  readonly table: readonly SettingRow[];
  readonly looks: readonly LookRow[];
  readonly regions: readonly RegionRow[];
  /** The reasons for which vessels are doubtful. */
  readonly doubts: readonly DoubtRow[];
  /** Where the page says stop to work under way, where it shares the worker's memory. */
  readonly stop: { readonly buffer: SharedArrayBuffer; readonly address: number } | null;
}
