/** Outline of a projected vessel: the union of discs at its points and quadrilaterals between them. */
import type { Pair } from '../core/messages';

export interface Disc {
  readonly at: Pair;
  readonly radius: number;
}

/** Discs closer together than this (CSS pixels) look alike, so all but one are left out. */
const STEP = 2;

/** The discs that are at least `STEP` apart, and always the last one. */
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

/** SVG path of the union, enlarged by `wider` CSS pixels. All parts turn the same way, so none cuts a hole. */
export function hullPath(discs: readonly Disc[], wider: number): string {
  const wide = ({ at, radius }: Disc): Disc => ({ at, radius: radius + wider });
  const larger = discs.map(wide);
  const between = larger.slice(1).map((disc, n) => quad(larger[n] ?? disc, disc));
  return [...withinEnds(discs).map(wide).map(circle), ...between].join('');
}

/** The discs that do not bulge beyond the ends, where a vessel leaves another one or the scan; all discs of a line seen end-on. */
function withinEnds(discs: readonly Disc[]): readonly Disc[] {
  const ends = [discs.at(0), discs.at(-1)].filter((end) => end !== undefined);
  const isWithin = ({ at, radius }: Disc) =>
    ends.every((end) => Math.hypot(at[0] - end.at[0], at[1] - end.at[1]) >= radius);
  const within = discs.filter(isWithin);
  return within.length > 0 ? within : discs;
}

/** The corners of the convex polygon around points, in order (monotone chain). */
export function around(points: readonly Pair[]): readonly Pair[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  return [...half(sorted), ...half(sorted.reverse())];
}

function half(points: readonly Pair[]): readonly Pair[] {
  const kept: Pair[] = [];
  for (const point of points) {
    while (kept.length > 1 && turn(kept.at(-2) ?? point, kept.at(-1) ?? point, point) <= 0) {
      kept.pop();
    }
    kept.push(point);
  }
  return kept.slice(0, -1);
}

const turn = (a: Pair, b: Pair, c: Pair): number =>
  (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

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
