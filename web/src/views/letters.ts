/** The sides of the patient at the edges of a view, and the length of its scale bar. */
import type { Vector } from '../core/messages';

/** A direction of less than this cosine is not named. */
const SEEN = 0.25;
const NAMES = [
  ['L', 'R'],
  ['P', 'A'],
  ['S', 'I'],
] as const;

/** The letters of a direction in LPS, the strongest first; at most two. */
export function lettersOf(direction: Vector): string {
  return direction
    .map((part, axis) => ({ part: Math.abs(part), letter: NAMES[axis]?.[part > 0 ? 0 : 1] ?? '' }))
    .filter(({ part }) => part > SEEN)
    .sort((a, b) => b.part - a.part)
    .slice(0, 2)
    .map(({ letter }) => letter)
    .join('');
}

/** The longest of 1, 2 and 5 times a power of ten that is not longer than `most` mm. */
export function barLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  const step = [5, 2, 1].find((factor) => factor * power <= most) ?? 1;
  return step * power;
}

/** A position as radiologists read it, such as `R 17.6 P 35.3 S 12.1` (mm); by axes where the sides are not known. */
export function positionText(point: Vector, isOriented = true): string {
  if (!isOriented) {
    return point.map((part, axis) => `${'xyz'[axis]} ${part.toFixed(1)}`).join(' ');
  }
  return point
    .map((part, axis) => `${NAMES[axis]?.[part >= 0 ? 0 : 1]} ${Math.abs(part).toFixed(1)}`)
    .join(' ');
}
