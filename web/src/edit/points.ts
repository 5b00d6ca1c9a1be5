/** The points that a vessel takes which was not clicked, so that it can be edited and still runs where it ran. */
import type { Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';

/** Points of a line that nobody clicked are so far apart (mm). */
const APART = 20;
/** No point is set so near to one of these (mm). */
const NEAREST = 5;

/** Both ends of a line, the point of a number, and points between them at distances that are alike. */
export function pointsAlong(points: readonly Vector[], number: number): Vector[] {
  const last = points.length - 1;
  const ways = waysAlong(points);
  const total = ways[last] ?? 0;
  const fixed = [0, number, last].map((n) => ways[n] ?? 0);
  const pieces = Math.max(1, Math.round(total / APART));
  const chosen = new Set([0, number, last]);
  for (let n = 1; n < pieces; n++) {
    const wanted = (n * total) / pieces;
    if (fixed.every((way) => Math.abs(way - wanted) > NEAREST)) {
      chosen.add(ways.findIndex((way) => way >= wanted));
    }
  }
  return [...chosen].sort((a, b) => a - b).map((n) => points[n] as Vector);
}

/** The arc length of each point (mm). */
function waysAlong(points: readonly Vector[]): number[] {
  let way = 0;
  return points.map((point, n) => {
    const before = points[n - 1];
    way += before ? length(subtract(point, before)) : 0;
    return way;
  });
}
