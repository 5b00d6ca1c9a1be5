/** Formats positions in the patient as text. */
import type { Vector } from '../core/messages';

const NAMES = [
  ['L', 'R'],
  ['P', 'A'],
  ['S', 'I'],
] as const;

/** A position such as `R 17.6 P 35.3 S 12.1` (mm); with x, y and z if the orientation is unknown. */
export function positionText(point: Vector, isOriented = true): string {
  if (!isOriented) {
    return point.map((part, axis) => `${'xyz'[axis]} ${part.toFixed(1)}`).join(' ');
  }
  return point
    .map((part, axis) => `${NAMES[axis]?.[part >= 0 ? 0 : 1]} ${Math.abs(part).toFixed(1)}`)
    .join(' ');
}
