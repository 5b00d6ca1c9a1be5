/** Basic types in messages to the engine. Points are in world coordinates (LPS, mm). */

export type Vector = readonly [number, number, number];
export type Pair = readonly [number, number];
/** Level and width of a grey-value window. */
export type Window = Pair;

/** Number of a centerline in the engine. An edit creates a new line and keeps the old one for undo. */
export type LineId = number;

export type SettingValue =
  | boolean
  | number
  | string
  | null
  | readonly (number | string)[]
  | readonly (readonly [number, Vector, number])[];
export type Settings = Readonly<Record<string, SettingValue>>;

export type Bytes = Uint8ClampedArray<ArrayBuffer>;

/** When the engine answers a request: before the current view, after it, or immediately. */
export interface Turn {
  readonly when: 'first' | 'later' | 'at once';
  /** Label of the progress bar for long work, which can be cancelled; null for short work. */
  readonly words: string | null;
}
