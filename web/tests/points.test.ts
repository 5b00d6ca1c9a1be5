import { expect, test } from 'vitest';
import type { Vector } from '../src/core/messages';
import { pointsAlong } from '../src/edit/points';

/** A straight line along x with a point at every mm. */
const line = (length: number): Vector[] => Array.from({ length: length + 1 }, (_, n) => [n, 0, 0]);
const along = (length: number, number: number) => pointsAlong(line(length), number).map(([x]) => x);

test.each([
  [60, 30, [0, 20, 30, 40, 60]],
  // Nothing so near to the point that was asked for.
  [60, 22, [0, 22, 40, 60]],
  // An end is no further point.
  [60, 60, [0, 20, 40, 60]],
  [12, 6, [0, 6, 12]],
  [1, 0, [0, 1]],
])('a line of %i mm that is taken hold of at %i mm has points at %j', (length, number, expected) => {
  expect(along(length, number)).toEqual(expected);
});
