/** Curves over a view: their SVG paths, and which curve lies under the pointer. */

import type { DocumentVessel, Pair, Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { document_ } from '../state/history';
import { contents } from '../state/lines';
import type { Projection } from './projection';

/** Points within this distance of a slice (mm) are drawn as lying in it. */
export const NEAR = 2;
const HIT_DISTANCE_PX = 7;

export const passesNear = (points: readonly Vector[], place: Vector, most: number): boolean =>
  points.some((point) => length(subtract(point, place)) <= most);

export const isNear = (projection: Projection, point: Vector): boolean =>
  projection.isThrough || Math.abs(projection.depth(point)) <= NEAR;

/** SVG path of the parts of a line that lie in the slice (`near`), or outside it (`far`). */
export function pathData(points: readonly Vector[], projection: Projection, which: 'near' | 'far'): string {
  const areNear = points.map((point) => isNear(projection, point));
  const pixels = points.map((point) =>
    projection
      .pixel(point)
      .map((part) => part.toFixed(1))
      .join(' '),
  );
  let path = '';
  let end = -1;
  for (let n = 0; n + 1 < points.length; n++) {
    if ((areNear[n] && areNear[n + 1]) === (which === 'near')) {
      path += end === n ? '' : `M${pixels[n]}`;
      path += `L${pixels[n + 1]}`;
      end = n + 1;
    }
  }
  return path;
}

export interface Hit {
  readonly vessel: DocumentVessel;
  readonly number: number;
  readonly point: Vector;
}

export function isAt(projection: Projection, point: Vector, [x, y]: Pair): boolean {
  const [column, row] = projection.pixel(point);
  return Math.hypot(column - x, row - y) <= HIT_DISTANCE_PX;
}

/** The curve nearest to a pixel; in a slice, only parts of curves that lie in it count. */
export function curveAt(projection: Projection, [x, y]: Pair): Hit | null {
  let best: Hit | null = null;
  let nearest = HIT_DISTANCE_PX;
  for (const vessel of document_.value.vessels) {
    const points = vessel.isHidden ? [] : (contents.value.get(vessel.line)?.points ?? []);
    points.forEach((point, number) => {
      const [column, row] = projection.pixel(point);
      const distance = Math.hypot(column - x, row - y);
      if (distance < nearest && isNear(projection, point)) {
        nearest = distance;
        best = { vessel, number, point };
      }
    });
  }
  return best;
}
