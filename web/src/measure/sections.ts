/** Finds sections of a profile by arc length or by pixel. */

import type { Pair, Profile, Vector } from '../core/messages';

/** Number of the section nearest to an arc length; of two equally near, the first. */
export function nearestSection({ arc_length: places }: Profile, at: number): number {
  let best = 0;
  places.forEach((place, n) => {
    if (Math.abs(place - at) < Math.abs((places[best] ?? 0) - at)) {
      best = n;
    }
  });
  return best;
}

export function snapped(profile: Profile, at: number): number {
  return profile.arc_length[nearestSection(profile, at)] ?? at;
}

/** Arc length of the last section (mm). */
export const lengthOf = (profile: Profile): number => profile.arc_length.at(-1) ?? 0;

export interface SectionNumbers {
  readonly at: number;
  readonly diameter: number | null;
  readonly uncertainty: number | null;
  readonly shortest: number | null;
  readonly longest: number | null;
  readonly area: number | null;
  readonly counts: boolean;
  readonly flags: readonly string[];
  /** Text about the uncertainty due to calcium or metal. */
  readonly bounds: string | null;
}

/** Side of a section picture: this many lumen diameters, within limits (mm); a default if nothing was measured. */
const SIDE_PER_DIAMETER = 2.5;
const SIZES: Pair = [12, 120];
export const UNKNOWN_SIDE = 30;

export function fittingSide({ counts, diameter_max: longest }: Profile): number {
  const all = longest.flatMap((value, n) => (value === null ? [] : [{ value, counts: counts[n] }]));
  const counted = all.filter((section) => section.counts);
  const wide = (counted.length > 0 ? counted : all).map(({ value }) => value).sort((a, b) => a - b);
  const most = wide[Math.floor(0.9 * (wide.length - 1))];
  return most === undefined
    ? UNKNOWN_SIDE
    : Math.min(Math.max(Math.ceil(SIDE_PER_DIAMETER * most), SIZES[0]), SIZES[1]);
}

export function sectionNumbers(profile: Profile, at: number): SectionNumbers {
  const n = nearestSection(profile, at);
  return {
    at: profile.arc_length[n] ?? at,
    diameter: profile.diameter[n] ?? null,
    uncertainty: profile.uncertainty[n] ?? null,
    shortest: profile.diameter_min[n] ?? null,
    longest: profile.diameter_max[n] ?? null,
    area: profile.area[n] ?? null,
    counts: profile.counts[n] ?? false,
    flags: profile.flags[n] ?? [],
    bounds: profile.bounds[n] ?? null,
  };
}

export function centerAt({ arc_length: places, center }: Profile, at: number): Vector | null {
  const after = places.findIndex((place) => place >= at);
  const [b, place] = [center[after], places[after]];
  if (!b || place === undefined) {
    return center.at(-1) ?? null;
  }
  const [a, before] = [center[after - 1], places[after - 1]];
  if (!a || before === undefined) {
    return b;
  }
  const share = (at - before) / (place - before);
  return [0, 1, 2].map(
    (axis) => (a[axis] ?? 0) + share * ((b[axis] ?? 0) - (a[axis] ?? 0)),
  ) as unknown as Vector;
}

/** Sections count as equally near if their distances from the pointer differ by at most this (pixels). */
const EQUALLY_NEAR_PX = 6;

/** Arc length (mm) of the section seen nearest to a pixel. Of equally near ones, the one closest to `before`. */
export function seenNearest(
  profile: Profile,
  seen: (point: Vector) => Pair,
  pixel: Pair,
  before: number,
): number {
  const distances = profile.center.map((point) => {
    const [x, y] = seen(point);
    return Math.hypot(x - pixel[0], y - pixel[1]);
  });
  const limit = Math.min(...distances) + EQUALLY_NEAR_PX;
  let best = before;
  let least = Number.POSITIVE_INFINITY;
  profile.arc_length.forEach((place, n) => {
    // Among sections that are equally near, the distance along the vessel decides.
    const distance = distances[n] ?? Number.POSITIVE_INFINITY;
    if (distance > limit) {
      return;
    }
    const cost = distance + 0.5 * Math.max(Math.abs(place - before) - 2 * EQUALLY_NEAR_PX, 0);
    if (cost < least) {
      [least, best] = [cost, place];
    }
  });
  return best;
}
