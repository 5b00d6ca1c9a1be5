import { describe, expect, test } from 'vitest';
import {
  colorOf,
  coloured,
  hex,
  MOST_POINTS,
  movedPoint,
  type Points,
  withoutPoint,
  withPoint,
} from '../src/core/transfer';

const POINTS: Points = [
  [0, [0, 0, 0], 0],
  [100, [200, 100, 50], 0.2],
  [300, [255, 255, 255], 0.6],
];

describe('control points of a transfer function', () => {
  test('stay between their neighbours and between 0 and 1', () => {
    expect(movedPoint(POINTS, 1, 150, 0.5)[1]).toEqual([150, [200, 100, 50], 0.5]);
    expect(movedPoint(POINTS, 1, 500, 1.5)[1]).toEqual([300, [200, 100, 50], 1]);
    expect(movedPoint(POINTS, 1, -500, -1)[1]).toEqual([0, [200, 100, 50], 0]);
    expect(movedPoint(POINTS, 0, -500, 0)[0]?.[0]).toBe(-500);
    expect(movedPoint(POINTS, 2, 900, 0.6)[2]?.[0]).toBe(900);
  });

  test('are added with the colour that the function has there', () => {
    const [more, at] = withPoint(POINTS, 50, 0.4);
    expect([at, more.length, more[1]]).toEqual([1, 4, [50, [100, 50, 25], 0.4]]);
    expect(withPoint(POINTS, -10, 0)[0][0]).toEqual([-10, [0, 0, 0], 0]);
    const [beyond, last] = withPoint(POINTS, 400, 0);
    expect([last, beyond[3]]).toEqual([3, [400, [255, 255, 255], 0]]);
    let many: Points = POINTS;
    for (let n = 0; n < 100; n += 1) {
      many = withPoint(many, n, 0.1)[0];
    }
    expect(many.length).toBe(MOST_POINTS);
    expect(many.map(([intensity]) => intensity)).toEqual(
      many.map(([intensity]) => intensity).sort((a, b) => a - b),
    );
  });

  test('are removed, but never all', () => {
    expect(withoutPoint(POINTS, 1)).toEqual([POINTS[0], POINTS[2]]);
    expect(withoutPoint(POINTS.slice(0, 1), 0)).toEqual(POINTS.slice(0, 1));
  });

  test('have colours as a colour field has them', () => {
    expect(hex([200, 9, 0])).toBe('#c80900');
    expect(colorOf('#c80900')).toEqual([200, 9, 0]);
    expect(coloured(POINTS, 2, [1, 2, 3])[2]).toEqual([300, [1, 2, 3], 0.6]);
  });
});
