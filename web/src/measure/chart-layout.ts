/** Layout of the profile chart (CSS pixels); its x axis is that of the vessel shown above it. */
import type { Pair, Profile } from '../core/messages';
import { topOf } from './curves';
import { flagsIn } from './flags';
import type { Axis } from './scale';
import { lengthOf } from './sections';

/** Margins for the tick labels on the left and the flag labels on the right. */
export const LEFT = 56;
export const RIGHT = 104;
/** Margins: legend and read-out above the chart, tick labels below it. */
const ABOVE = 38;
const BELOW = 34;
export const ROW = 12;
/** Height of a flag label. If the rows are lower than this, the labels extend upwards. */
const WORD = 11;
/** Flag rows take at most this share of the chart height. */
const MOST_ROWS = 0.45;

export interface ChartLayout {
  readonly size: Pair;
  readonly x: Axis;
  readonly y: Axis;
  /** Height of a flag row; the first row begins at diameter 0. */
  readonly row: number;
  /** Distance between flag labels; the last label is level with the last row. */
  readonly wordRow: number;
  readonly bottom: number;
}

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

/** Smallest distance of a bar from the edges of its pane (CSS pixels). */
const EDGE = 4;

/** Left edge of a bar centred on a column, within the pane (CSS pixels). */
export const leftOf = (column: number, wide: number, room: number): number =>
  Math.max(Math.min(column - wide / 2, room - wide - EDGE), EDGE);
