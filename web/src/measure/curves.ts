/** Curves of a profile as SVG paths. */
import type { Profile } from '../core/messages';
import { type Axis, pixelAt } from './scale';

/** Half the height of the uncertainty band, in standard deviations. */
export const DEVIATIONS = 2;
const AXIS_HEADROOM = 1.12;

/** The values, with null for sections that are left out. */
export function counted({ counts }: Profile, values: readonly (number | null)[]): (number | null)[] {
  return values.map((value, n) => (counts[n] ? value : null));
}

/** Runs of consecutive sections with a value, as indices of the sections. */
export function stretches(values: readonly (number | null)[]): number[][] {
  const found: number[][] = [];
  values.forEach((value, n) => {
    if (value === null) {
      return;
    }
    if (n > 0 && values[n - 1] !== null) {
      found.at(-1)?.push(n);
    } else {
      found.push([n]);
    }
  });
  return found;
}

/** Upper end of the diameter axis (mm). */
export function topOf(profile: Profile): number {
  const some = (values: readonly (number | null)[]) => values.filter((value) => value !== null);
  const wide = some(counted(profile, profile.diameter_max));
  const all = wide.length > 0 ? wide : some(profile.diameter_max);
  return all.length > 0 ? AXIS_HEADROOM * Math.max(...all) : 1;
}

/** A line through the values, interrupted where they are missing. */
export function linePath(
  x: Axis,
  y: Axis,
  at: readonly number[],
  values: readonly (number | null)[],
): string {
  return stretches(values)
    .filter((run) => run.length > 1)
    .map((run) => `M${run.map((n) => pointOf(x, y, at[n], values[n])).join('L')}`)
    .join('');
}

export function bandPath(
  x: Axis,
  y: Axis,
  at: readonly number[],
  [low, high]: readonly [readonly (number | null)[], readonly (number | null)[]],
): string {
  const both = low.map((value, n) => (high[n] === null ? null : value));
  return stretches(both)
    .filter((run) => run.length > 1)
    .map((run) => {
      const upper = run.map((n) => pointOf(x, y, at[n], high[n]));
      const lower = run.map((n) => pointOf(x, y, at[n], low[n])).reverse();
      return `M${[...upper, ...lower].join('L')}Z`;
    })
    .join('');
}

export const isolated = (values: readonly (number | null)[]): number[] =>
  stretches(values).flatMap((run) => (run.length === 1 ? run : []));

function pointOf(x: Axis, y: Axis, at = 0, value: number | null = 0): string {
  return `${pixelAt(x, at).toFixed(2)} ${pixelAt(y, value ?? 0).toFixed(2)}`;
}

export function spreadOf(profile: Profile): readonly [(number | null)[], (number | null)[]] {
  const widths = counted(profile, profile.diameter);
  const by = (sign: number) =>
    widths.map((width, n) => {
      const deviation = profile.uncertainty[n] ?? null;
      return width === null || deviation === null ? null : Math.max(width + sign * DEVIATIONS * deviation, 0);
    });
  return [by(-1), by(1)];
}
