/** Where a point of the patient is, in words. */
import type { Vector } from '../core/messages';

const NAMES = [
  ['L', 'R'],
  ['P', 'A'],
  ['S', 'I'],
] as const;

/** A position as radiologists read it, such as `R 17.6 P 35.3 S 12.1` (mm); by axes where the sides are not known. */
export function positionText(point: Vector, isOriented = true): string {
  if (!isOriented) {
    return point.map((part, axis) => `${'xyz'[axis]} ${part.toFixed(1)}`).join(' ');
  }
  return point
    .map((part, axis) => `${NAMES[axis]?.[part >= 0 ? 0 : 1]} ${Math.abs(part).toFixed(1)}`)
    .join(' ');
}
