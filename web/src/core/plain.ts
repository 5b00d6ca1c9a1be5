/** Basic types of messages. Points are in world coordinates (LPS, mm). */

export type Vector = readonly [number, number, number];
export type Pair = readonly [number, number];
/** Level and width. */
export type Window = Pair;

/** Number of a line in the engine. Lines are immutable: every edit creates a new one, which undo relies on. */
export type LineId = number;

export type SettingValue = boolean | number | string | null | readonly (number | string)[];
export type Settings = Readonly<Record<string, SettingValue>>;

export type Bytes = Uint8ClampedArray<ArrayBuffer>;

/** When a question is answered: before the current view, after it, or immediately. */
export interface Turn {
  readonly when: 'first' | 'later' | 'at once';
  /** Label of the progress, for long work that can be cancelled. */
  readonly words: string | null;
}
