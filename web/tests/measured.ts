/** A synthetic measured vessel. */
import type { Profile, Vector } from '../src/core/messages';
import { NO_MARKS, type VesselMarks } from '../src/state/document';

/** A profile with sections every 0.5 mm: diameter 8 mm, in the middle 4 mm. The first 1 mm is not measured. */
export function madeProfile(length = 60): Profile {
  const places = Array.from({ length: 2 * length + 1 }, (_, n) => n / 2);
  const width = (at: number) => (Math.abs(at - length / 2) < 4 ? 4 : 8);
  const diameter = places.map((at) => (at < 1 ? null : width(at)));
  const scaled = (factor: number) => diameter.map((value) => (value === null ? null : factor * value));
  return {
    arc_length: places,
    diameter,
    diameter_min: scaled(0.9),
    diameter_max: scaled(1.1),
    area: diameter.map((value) => (value === null ? null : (Math.PI * value * value) / 4)),
    uncertainty: diameter.map((value) => (value === null ? null : 0.1)),
    counts: places.map((at) => at >= 1 && at <= length - 10),
    flags: places.map((at) => (at > length - 10 ? ['branch'] : Math.abs(at - 20) <= 1 ? ['calcium'] : [])),
    bounds: places.map(() => null),
    flag_table: ['branch', 'calcium', 'metal', 'irregular'].map((word, n) => ({
      word,
      meaning: `what ${word} means`,
      screen: `#fffff${n}`,
    })),
    center: places.map((at): Vector => [0, 0, at]),
    fwhm: 1.2,
    fwhm_source: 'given',
    wall_source: 'not separated, as requested',
    narrowest: { at: length / 2, diameter: 4 },
    throat: null,
    passed_over: null,
    widest: { at: 10, diameter: 8.8 },
    not_suggested: [],
    not_measured: [],
    outer_stretch: null,
    outer: places.map(() => null),
    flap_stretch: null,
    lumens: places.map(() => null),
  };
}

export const marks = (some: Partial<VesselMarks>): VesselMarks => ({ ...NO_MARKS, ...some });
