/** Vessel colours, first those of Okabe and Ito that are visible on dark. Yellow, orange and red signal warnings. */
import type { DocumentVessel } from '../core/messages';

export const PALETTE: readonly (readonly [color: string, words: string])[] = [
  ['#56b4e9', 'sky blue'],
  ['#cc79a7', 'pink'],
  ['#00b98a', 'green'],
  ['#b18cff', 'violet'],
  ['#8fdc6a', 'light green'],
  ['#ffa6dc', 'rose'],
  ['#3f6fe0', 'blue'],
  ['#8ff0e8', 'turquoise'],
  ['#c44df0', 'purple'],
  ['#2f8f9f', 'teal'],
  ['#9aa8b6', 'grey'],
  ['#ffffff', 'white'],
];

export const DOUBTFUL = '#ffa500';

/** The colour that the fewest vessels have; of several, the first in the palette. */
export function nextColor(vessels: readonly DocumentVessel[]): string {
  const counts = PALETTE.map(([color]) => vessels.filter((vessel) => vessel.color === color).length);
  return PALETTE[counts.indexOf(Math.min(...counts))]?.[0] ?? '#ffffff';
}
