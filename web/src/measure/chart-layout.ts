/** Where things lie in the picture of a profile (CSS pixels). The picture of the vessel above it has the same axis `x`. */
import type { Pair, Profile } from '../core/messages';
import { topOf } from './curves';
import { flagsIn } from './flags';
import type { Axis } from './scale';
import { lengthOf } from './sections';

/** Room for the numbers at the left, and for words at the right. */
export const LEFT = 56;
export const RIGHT = 104;
/** Room for the legend and the reading above, a line for each, and for the ticks below. */
const ABOVE = 38;
const BELOW = 34;
/** The height of a row of flags. */
export const ROW = 12;
/** The height of a word beside the rows: where rows are lower, the words spread upwards beside the curve. */
const WORD = 11;
/** Rows never take more than this part of the height. */
const MOST_ROWS = 0.45;

export interface ChartLayout {
  readonly size: Pair;
  readonly x: Axis;
  readonly y: Axis;
  /** The height of a row of flags, the first of which begins where the diameter is 0. */
  readonly row: number;
  /** How far the words beside these rows are apart: the last one stands at the last row. */
  readonly wordRow: number;
  /** Where the plot ends below the rows of flags. */
  readonly bottom: number;
}

/** The axis along the vessel in a picture of this width. */
export function axisAlong(length: number, width: number): Axis {
  return { low: 0, high: length, start: LEFT, end: Math.max(width - RIGHT, LEFT + 20) };
}

export function chartLayout(profile: Profile, size: Pair): ChartLayout {
  const bottom = Math.max(size[1] - BELOW, ABOVE + 20);
  const rows = flagsIn(profile).length;
  const row = rows === 0 ? 0 : Math.min(ROW, (MOST_ROWS * (bottom - ABOVE)) / rows);
  return {
    size,
    x: axisAlong(lengthOf(profile), size[0]),
    y: { low: 0, high: topOf(profile), start: bottom - rows * row, end: ABOVE },
    row,
    wordRow: Math.max(row, WORD),
    bottom,
  };
}

/** How far a bar over the chart stays away from both edges (CSS pixels). */
const EDGE = 4;

/** Where a bar of a width begins that stands over a column as long as it has room on both sides (CSS pixels). */
export const leftOf = (column: number, wide: number, room: number): number =>
  Math.max(Math.min(column - wide / 2, room - wide - EDGE), EDGE);
