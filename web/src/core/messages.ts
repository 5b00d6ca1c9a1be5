/** What the page and its worker tell each other. Points are in world space (LPS, mm). */

export type Vector = readonly [number, number, number];
export type Pair = readonly [number, number];

/** A camera: orthographic, its axes unit vectors. */
export interface Camera {
  readonly center: Vector;
  /** From the viewer into the scene. */
  readonly direction: Vector;
  readonly up: Vector;
  /** Columns and rows. */
  readonly size: Pair;
  /** The side of a pixel (mm). */
  readonly pixel_spacing: number;
}

export type Method = 'csr' | 'csr-paper' | 'mpcpr' | 'cr';

export type SettingValue = boolean | number | string | null | readonly (number | string)[];
export type Settings = Readonly<Record<string, SettingValue>>;

/** What the turning view is asked for. */
export interface View {
  readonly camera: Camera;
  readonly method: Method;
  readonly settings: Settings;
}

/** A row of the table of settings. */
export interface SettingRow {
  readonly name: string;
  readonly kind: string;
  readonly optional: boolean;
  readonly default: SettingValue;
  readonly low: number | null;
  readonly high: number | null;
  readonly unit: string | null;
  readonly choices: readonly string[];
  readonly open: string | null;
  readonly sentence: string;
}

/** What lies at a place. */
export interface Pick {
  readonly point: Vector;
  readonly value: number | null;
  readonly vessel: number | null;
  readonly arc_length: number | null;
}

/** A flat picture. */
export interface Plane {
  readonly center: Vector;
  readonly right: Vector;
  readonly down: Vector;
  readonly size: Pair;
  readonly pixel_spacing: number;
}

/** How a picture lies: unit vectors to the right and downwards, its width in pixels and their side (mm). */
export interface LaidPicture {
  readonly right: Vector;
  readonly down: Vector;
  readonly width: number;
  readonly pixel_spacing: number;
}

/** What stands around a picture: the letters of the patient's sides, and the scale bar. */
export interface PictureLabels {
  readonly letters: Readonly<Record<'left' | 'right' | 'top' | 'bottom', string>>;
  /** Its length (mm) in words, and in pixels; none for a picture without a width. */
  readonly bar: { readonly length: number; readonly words: string; readonly pixels: number } | null;
}

/** The straightened CPR of a vessel. */
export interface Cpr {
  readonly vessel: number;
  /** Rotation about the vessel's axis (radians). */
  readonly angle: number;
  /** Width of the picture (mm). */
  readonly width: number;
  readonly pixel_spacing: number;
  /** Which value of the half circle on its side a pixel shows (CFA); none is its own. */
  readonly feature: Feature | null;
}

export type Feature = 'max' | 'mean' | 'min';

/** Level and width. */
export type Window = Pair;

export interface VolumeReport {
  readonly size: Vector;
  readonly world_from_index: readonly (readonly number[])[];
  readonly corners: readonly Vector[];
  readonly smallest_side: number;
}

/** The number of a line that the engine holds. A line never changes: every edit makes another one, so that undo shows the former. */
export type LineId = number;

export interface VesselReport {
  readonly line: LineId;
  readonly name: string;
  /** mm */
  readonly length: number;
  readonly has_radius: boolean;
}

/** The windows of what is open, as the core decides them. */
export interface Windows {
  /** That of cut surface and flat views. */
  readonly main: Window;
  /** Those of the contexts, by their names. */
  readonly contexts: Readonly<Record<string, Window>>;
  /** Those that have a name, in the order to show them. */
  readonly presets: readonly { readonly name: string; readonly words: string; readonly window: Window }[];
}

/** What is open. */
export interface Report {
  readonly volume: VolumeReport | null;
  readonly vessels: readonly VesselReport[] | null;
  readonly windows: Windows | null;
}

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
  /** Every second voxel along each axis alone: where there is no memory for all of them. */
  readonly every_second?: boolean;
}

/** How many voxels are in each of equally wide bins between two values. */
export interface Histogram {
  readonly low: number;
  readonly high: number;
  readonly counts: readonly number[];
}

/** RGBA in rows from the top. */
export interface Picture {
  readonly size: Pair;
  readonly bytes: Uint8ClampedArray<ArrayBuffer>;
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
  /** Where the page says stop to work under way, where it shares the worker's memory. */
  readonly stop: { readonly buffer: SharedArrayBuffer; readonly address: number } | null;
}
