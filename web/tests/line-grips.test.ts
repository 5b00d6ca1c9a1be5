/** Which place a drag moves: the one whose line is nearest to the pointer. */
import { expect, test } from 'vitest';
import { GRAB_DISTANCE_PX, nearestLine } from '../src/measure/line-grips';
import type { VesselPlace } from '../src/measure/marks';

const place = (at: number): VesselPlace => ({ kind: 'place', slot: 0, at, isSuggestion: false });
/** An axis with 10 pixels per mm that starts at pixel 5. */
const AXIS = { low: 0, high: 60, start: 5, end: 605 };

test('a drag moves the nearest line within 22 pixels, and none that is farther away', () => {
  const places = [place(30), place(33)];
  expect(nearestLine(places, AXIS, 305 - GRAB_DISTANCE_PX)?.at).toBe(30);
  expect(nearestLine(places, AXIS, 305 - GRAB_DISTANCE_PX - 1)).toBeNull();
  expect(nearestLine(places, AXIS, 319)?.at).toBe(30);
  expect(nearestLine(places, AXIS, 321)?.at).toBe(33);
  expect(nearestLine([], AXIS, 305)).toBeNull();
});
