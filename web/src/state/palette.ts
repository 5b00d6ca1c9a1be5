/** Vessel colours. */
import { PALETTE } from '../core/generated/tables';
import type { DocumentVessel } from '../core/messages';

export { PALETTE };

export const DOUBTFUL = '#ffa500';

/** The least used colour, the first of several. */
export function nextColor(vessels: readonly DocumentVessel[]): string {
  const counts = PALETTE.map(([color]) => vessels.filter((vessel) => vessel.color === color).length);
  return PALETTE[counts.indexOf(Math.min(...counts))]?.[0] ?? '#ffffff';
}
