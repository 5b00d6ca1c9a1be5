/** The colours of vessels: those of Okabe and Ito that stand out on a dark picture, told apart also by the colour-blind. */
import type { DocumentVessel } from '../core/messages';

export const PALETTE: readonly (readonly [color: string, words: string])[] = [
  ['#f0e442', 'yellow'],
  ['#56b4e9', 'sky blue'],
  ['#cc79a7', 'pink'],
  ['#00b98a', 'green'],
  ['#ffffff', 'white'],
  ['#d5763f', 'copper'],
  ['#5b8ff9', 'blue'],
  ['#b8b06a', 'olive'],
];

/** Of branches that were not accepted yet; no vessel has it. */
export const DOUBTFUL = '#ffa500';

/** The colour that the fewest vessels have, the first of several such. */
export function nextColor(vessels: readonly DocumentVessel[]): string {
  const counts = PALETTE.map(([color]) => vessels.filter((vessel) => vessel.color === color).length);
  return PALETTE[counts.indexOf(Math.min(...counts))]?.[0] ?? '#ffffff';
}
