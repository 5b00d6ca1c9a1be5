import type { Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { isNear } from './curves';
import type { Projection } from './projection';

export interface LinePlace {
  /** Arc length (mm). */
  readonly at: number;
  readonly point: Vector;
}

/** Least distance of neighbouring grips (CSS pixels). */
export const APART_PX = 48;

/** Places at equal distances along the parts of a line that lie in the slice; each part has at least one. */
export function gripsOf(points: readonly Vector[], projection: Projection): LinePlace[] {
  const step = APART_PX * projection.spacing;
  const grips: LinePlace[] = [];
  let part: LinePlace[] = [];
  let at = 0;
  points.forEach((point, n) => {
    at += n > 0 ? length(subtract(point, points[n - 1] ?? point)) : 0;
    if (isNear(projection, point)) {
      part.push({ at, point });
    }
    if (part.length > 0 && (!isNear(projection, point) || n === points.length - 1)) {
      grips.push(...chosen(part, step, projection));
      part = [];
    }
  });
  return grips;
}

function chosen(part: readonly LinePlace[], step: number, projection: Projection): LinePlace[] {
  const spread = part.filter(
    ({ at }, n) => n > 0 && Math.floor(at / step) > Math.floor((part[n - 1]?.at ?? 0) / step),
  );
  const depth = ({ point }: LinePlace) => Math.abs(projection.depth(point));
  const nearest = [...part].sort((a, b) => depth(a) - depth(b))[0];
  return spread.length > 0 || !nearest ? spread : [nearest];
}
