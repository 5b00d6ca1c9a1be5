/** Outline of a projected vessel: discs at its points, and quads between them. */
import type { Pair } from '../core/messages';

export interface Disc {
  readonly at: Pair;
  readonly radius: number;
}

/** Closer points are indistinguishable in the picture (CSS pixels). */
const STEP = 2;

/** Discs at visible distances, always with the last. */
export function thinned(discs: readonly Disc[]): readonly Disc[] {
  const kept: Disc[] = [];
  discs.forEach((disc, n) => {
    const last = kept.at(-1);
    const isApart = !last || Math.hypot(disc.at[0] - last.at[0], disc.at[1] - last.at[1]) >= STEP;
    if (isApart || n === discs.length - 1) {
      kept.push(disc);
    }
  });
  return kept;
}

/** Path of the union of discs enlarged by `wider` CSS pixels; all parts have one orientation, so none cuts holes. */
export function hullPath(discs: readonly Disc[], wider: number): string {
  const larger = discs.map(({ at, radius }) => ({ at, radius: radius + wider }));
  const between = larger.slice(1).map((disc, n) => quad(larger[n] ?? disc, disc));
  return [...larger.map(circle), ...between].join('');
}

const coordinates = (x: number, y: number): string => `${x.toFixed(1)} ${y.toFixed(1)}`;

function circle({ at: [x, y], radius }: Disc): string {
  const arc = `A${radius.toFixed(1)} ${radius.toFixed(1)} 0 1 1 `;
  return `M${coordinates(x - radius, y)}${arc}${coordinates(x + radius, y)}${arc}${coordinates(x - radius, y)}Z`;
}

function quad(from: Disc, to: Disc): string {
  const way = [to.at[0] - from.at[0], to.at[1] - from.at[1]] as const;
  const length = Math.hypot(...way);
  if (length === 0) {
    return '';
  }
  const across = [-way[1] / length, way[0] / length] as const;
  const end = ({ at, radius }: Disc, side: number) =>
    coordinates(at[0] + side * radius * across[0], at[1] + side * radius * across[1]);
  return `M${end(from, 1)}L${end(from, -1)}L${end(to, -1)}L${end(to, 1)}Z`;
}
