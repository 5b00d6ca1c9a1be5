/** The outline of a vessel in projection: discs around the points of its line, and what lies between two of them. */
import type { Pair } from '../core/messages';

export interface Disc {
  readonly at: Pair;
  /** CSS pixels. */
  readonly radius: number;
}

/** Points that are nearer to each other in the picture change nothing that is seen (CSS pixels). */
const STEP = 2;

/** The discs that are seen apart, the last one among them. */
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

/** The path of the union of discs that are `wider` CSS pixels larger; all its parts turn the same way, so none cuts another out. */
export function hullPath(discs: readonly Disc[], wider: number): string {
  const larger = discs.map(({ at, radius }) => ({ at, radius: radius + wider }));
  const between = larger.slice(1).map((disc, n) => quad(larger[n] ?? disc, disc));
  return [...larger.map(circle), ...between].join('');
}

const told = (x: number, y: number): string => `${x.toFixed(1)} ${y.toFixed(1)}`;

function circle({ at: [x, y], radius }: Disc): string {
  const arc = `A${radius.toFixed(1)} ${radius.toFixed(1)} 0 1 1 `;
  return `M${told(x - radius, y)}${arc}${told(x + radius, y)}${arc}${told(x - radius, y)}Z`;
}

/** What lies between two discs: the diameters across their way, joined at their ends. */
function quad(from: Disc, to: Disc): string {
  const way = [to.at[0] - from.at[0], to.at[1] - from.at[1]] as const;
  const length = Math.hypot(...way);
  if (length === 0) {
    return '';
  }
  const across = [-way[1] / length, way[0] / length] as const;
  const end = ({ at, radius }: Disc, side: number) =>
    told(at[0] + side * radius * across[0], at[1] + side * radius * across[1]);
  return `M${end(from, 1)}L${end(from, -1)}L${end(to, -1)}L${end(to, 1)}Z`;
}
