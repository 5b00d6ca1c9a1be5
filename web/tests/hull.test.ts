import { expect, test } from 'vitest';
import { around, type Disc, hullPath, thinned } from '../src/views/hull';

const disc = (x: number, y: number, radius: number): Disc => ({ at: [x, y], radius });

/** Corners of a closed part of an SVG path; of an arc, its end. */
function corners(part: string): readonly (readonly [number, number])[] {
  const ends = part.replaceAll(/A[\d.]+ [\d.]+ 0 1 1 /g, 'L');
  return [...ends.matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g)].map(([, x, y]) => [Number(x), Number(y)] as const);
}

test('the polygon around the corners of a projected scan is convex and holds all of them', () => {
  const square = [
    [0, 0],
    [4, 0],
    [4, 4],
    [0, 4],
  ] as const;
  expect(around([[2, 2], ...square, [1, 3]])).toEqual(square);
});

/** Twice the signed area of a polygon. */
function turned(points: readonly (readonly [number, number])[]): number {
  const sum = (n: number) => {
    const [a, b] = [points[n] ?? [0, 0], points[(n + 1) % points.length] ?? [0, 0]];
    return a[0] * b[1] - b[0] * a[1];
  };
  return points.reduce((all, _, n) => all + sum(n), 0);
}

test('of points at the same pixel only one is kept, and always the last one', () => {
  const discs = [disc(0, 0, 3), disc(0.5, 0, 3), disc(2.5, 0, 4), disc(3, 0, 5)];
  expect(thinned(discs)).toEqual([discs[0], discs[2], discs[3]]);
  expect(thinned([])).toEqual([]);
});

test('a hull is a circle around each point and a strip between two points, widened as requested', () => {
  const parts = hullPath([disc(10, 20, 3), disc(10, 50, 5)], 2)
    .split('Z')
    .filter(Boolean);
  expect(parts).toHaveLength(3);
  expect(parts[0]).toBe('M5.0 20.0A5.0 5.0 0 1 1 15.0 20.0A5.0 5.0 0 1 1 5.0 20.0');
  expect(corners(parts[2] ?? '').toSorted(([a, b], [c, d]) => b - d || a - c)).toEqual([
    [5, 20],
    [15, 20],
    [3, 50],
    [17, 50],
  ]);
});

test('strips have the same orientation as circles, whatever the direction of the vessel', () => {
  for (let n = 0; n < 12; n++) {
    const angle = (2 * Math.PI * n) / 12;
    const path = hullPath([disc(0, 0, 4), disc(30 * Math.cos(angle), 30 * Math.sin(angle), 4)], 0);
    // Since y points downwards, an arc with sweep flag 1 encloses a positive area.
    expect(turned(corners(path.split('Z')[2] ?? ''))).toBeGreaterThan(0);
  }
});

test('no circle bulges beyond the ends of a long vessel, and one seen end-on is a circle', () => {
  const long = Array.from({ length: 21 }, (_, n) => disc(0, 2 * n, 5));
  const circles = hullPath(long, 2)
    .split('Z')
    .filter((part) => part.includes('A'));
  const middles = circles.map((part) => corners(part)[0]?.[1] ?? 0);
  expect(Math.min(...middles)).toBe(6);
  expect(Math.max(...middles)).toBe(34);
  const across = [disc(1, 1, 5), disc(2, 1, 5), disc(3, 1, 5)];
  expect(hullPath(across, 0).match(/Z/g)).toHaveLength(5);
});

test('there is no strip between two points at the same position', () => {
  expect(
    hullPath([disc(1, 1, 2), disc(1, 1, 2)], 0)
      .split('Z')
      .filter(Boolean),
  ).toHaveLength(2);
});
