/** Numbers and texts that messages are made of. Points are in world space (LPS, mm). */

export type Vector = readonly [number, number, number];
export type Pair = readonly [number, number];
/** Level and width. */
export type Window = Pair;

/** The number of a line that the engine holds. A line never changes: every edit makes another one, so that undo shows the former. */
export type LineId = number;

export type SettingValue = boolean | number | string | null | readonly (number | string)[];
export type Settings = Readonly<Record<string, SettingValue>>;

/** Bytes of a picture or a file. */
export type Bytes = Uint8ClampedArray<ArrayBuffer>;

/** When a question is answered: with the view under way giving way to it, after that view, or at once, beside whatever is done. */
export interface Turn {
  readonly when: 'first' | 'later' | 'at once';
  /** What is done, for what takes long and can be cancelled. */
  readonly words: string | null;
}
