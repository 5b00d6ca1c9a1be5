/** Marked places of a vessel, and suggestions for those not yet marked. */
import type { Pair, Profile, Spot } from '../core/messages';
import type { VesselMarks } from '../state/document';
import { lengthOf } from './sections';

/** `place` is the stenosis; `diameter` is a noted diameter. */
export type Kind = 'place' | 'reference' | 'stretch' | 'secondStretch' | 'diameter';

export interface VesselPlace {
  readonly kind: Kind;
  /** Slot 0 lies before slot 1; noted diameters are numbered in order of entry. */
  readonly slot: number;
  readonly at: number;
  /** Suggested by Lumencut, not marked by the user. */
  readonly isSuggestion: boolean;
  /** For references: whether it precedes the stenosis, even if both lie on one side. */
  readonly isBefore?: boolean;
}

export type Suggested = readonly [Spot | null, Spot | null];
export const NOTHING_SUGGESTED: Suggested = [null, null];

export function mainPlace(profile: Profile, marks: VesselMarks): VesselPlace | null {
  const at = marks.at ?? profile.narrowest?.at ?? null;
  return at === null ? null : { kind: 'place', slot: 0, at, isSuggestion: marks.at === null };
}

export function referenceSlots({ references }: VesselMarks, main: number): [number | null, number | null] {
  const [first, second] = [...references].sort((a, b) => a - b);
  if (first === undefined) {
    return [null, null];
  }
  return second !== undefined ? [first, second] : first < main ? [first, null] : [null, first];
}

export function placesOf(profile: Profile, marks: VesselMarks, suggested: Suggested): VesselPlace[] {
  const main = mainPlace(profile, marks);
  const references = main
    ? shownReferences(marks, main.at, suggested)
    : marks.references.map((at, slot): VesselPlace => ({ kind: 'reference', slot, at, isSuggestion: false }));
  return [...(main ? [main] : []), ...references, ...stretchEnds(marks), ...noted(marks)];
}

export interface ComparedPlaces {
  readonly at: number;
  readonly references: readonly VesselPlace[];
}

/** Null without a stenosis. */
export function comparedIn(places: readonly VesselPlace[]): ComparedPlaces | null {
  const main = places.find(({ kind }) => kind === 'place');
  return main ? { at: main.at, references: places.filter(({ kind }) => kind === 'reference') } : null;
}

function shownReferences(marks: VesselMarks, main: number, suggested: Suggested): VesselPlace[] {
  const places: VesselPlace[] = [];
  referenceSlots(marks, main).forEach((at, n) => {
    const slot = n;
    const offered = suggested[n]?.at ?? null;
    if (at !== null) {
      places.push({ kind: 'reference', slot, at, isSuggestion: false, isBefore: at < main });
    } else if (offered !== null) {
      places.push({ kind: 'reference', slot, at: offered, isSuggestion: true, isBefore: offered < main });
    }
  });
  return places;
}

const noted = ({ diameters }: VesselMarks): VesselPlace[] =>
  diameters.map((at, slot) => ({ kind: 'diameter', slot, at, isSuggestion: false }));

function stretchEnds(marks: VesselMarks): VesselPlace[] {
  return (['stretch', 'secondStretch'] as const).flatMap((kind) =>
    (marks[kind] ?? []).map((at, n) => ({ kind, slot: n, at, isSuggestion: false })),
  );
}

/** Moves a place; a moved suggestion becomes a mark. In a drag, pass marks and place from its start. */
export function moved(profile: Profile, marks: VesselMarks, place: VesselPlace, to: number): VesselMarks {
  const at = within(to, [0, lengthOf(profile)]);
  if (place.kind === 'place') {
    // The stenosis may pass its references; the engine then reports why it cannot grade.
    return { ...marks, at };
  }
  if (place.kind === 'reference') {
    return { ...marks, references: movedReferences(profile, marks, place.slot, at) };
  }
  if (place.kind === 'diameter') {
    return { ...marks, diameters: marks.diameters.with(place.slot, at) };
  }
  const ends = marks[place.kind] ?? [at, at];
  const other = ends[1 - place.slot] ?? at;
  // The ends keep their order and a minimum distance.
  const kept: Pair =
    place.slot === 0
      ? [Math.min(at, other - LEAST_STRETCH), other]
      : [other, Math.max(at, other + LEAST_STRETCH)];
  return { ...marks, [place.kind]: kept };
}

/** A reference may pass the stenosis unless the other one is already there. */
function movedReferences(profile: Profile, marks: VesselMarks, slot: number, at: number): number[] {
  const main = mainPlace(profile, marks)?.at ?? 0;
  const slots = referenceSlots(marks, main);
  const [before, other] = [slots[slot] ?? null, slots[1 - slot] ?? null];
  // Two references loaded on one side move freely.
  const areOnOneSide = before !== null && (slot === 0 ? before > main : before < main);
  const side: Pair = slot === 0 ? [0, main] : [main, lengthOf(profile)];
  const now = other === null || areOnOneSide ? at : within(at, side);
  return [now, ...(other === null ? [] : [other])].sort((a, b) => a - b);
}

/** Position of a place after a move, which may be limited or on the other side. */
export function placeAfter(
  profile: Profile,
  marks: VesselMarks,
  place: VesselPlace,
  after: VesselMarks,
): VesselPlace {
  const { kind, slot } = place;
  if (kind === 'place') {
    return { ...place, at: after.at ?? place.at, isSuggestion: false };
  }
  if (kind === 'diameter') {
    return { ...place, at: after.diameters[slot] ?? place.at };
  }
  if (kind === 'stretch' || kind === 'secondStretch') {
    return { ...place, at: after[kind]?.[slot] ?? place.at };
  }
  const main = mainPlace(profile, after)?.at ?? 0;
  const other = referenceSlots(marks, main)[1 - slot] ?? null;
  const slots = referenceSlots(after, main);
  const now = slots[slot] !== null && (slots[slot] !== other || slots[0] === slots[1]) ? slot : 1 - slot;
  return { ...place, slot: now, at: slots[now] ?? place.at, isSuggestion: false };
}

/** Removes a place; a stretch goes as a whole, suggestions stay. */
export function removed(marks: VesselMarks, place: VesselPlace): VesselMarks {
  if (place.isSuggestion) {
    return marks;
  }
  if (place.kind === 'place') {
    return { ...marks, at: null };
  }
  if (place.kind === 'reference') {
    return { ...marks, references: marks.references.filter((at) => at !== place.at) };
  }
  if (place.kind === 'diameter') {
    return { ...marks, diameters: marks.diameters.toSpliced(place.slot, 1) };
  }
  return place.kind === 'stretch'
    ? { ...marks, stretch: marks.secondStretch, secondStretch: null }
    : { ...marks, secondStretch: null };
}

/** Replaces the reference on the same side of the stenosis. */
export function withReference(profile: Profile, marks: VesselMarks, at: number): VesselMarks {
  const main = mainPlace(profile, marks)?.at ?? 0;
  const other = referenceSlots(marks, main)[at < main ? 1 : 0];
  return { ...marks, references: [at, ...(other === null ? [] : [other])].sort((a, b) => a - b) };
}

export const withDiameter = (marks: VesselMarks, at: number): VesselMarks =>
  marks.diameters.includes(at) ? marks : { ...marks, diameters: [...marks.diameters, at] };

export const isFull = ({ stretch, secondStretch }: VesselMarks): boolean => Boolean(stretch && secondStretch);

/** Shortest stretch (mm). */
const LEAST_STRETCH = 1;

export function withStretch(profile: Profile, marks: VesselMarks, one: number, other: number): VesselMarks {
  const from = within(Math.min(one, other), [0, lengthOf(profile) - LEAST_STRETCH]);
  const ends: Pair = [from, Math.max(one, other, from + LEAST_STRETCH)];
  return marks.stretch ? { ...marks, secondStretch: ends } : { ...marks, stretch: ends };
}

/** Turns a suggestion into a mark at its exact position. */
export function taken(marks: VesselMarks, { kind, at }: VesselPlace): VesselMarks {
  return kind === 'place'
    ? { ...marks, at }
    : { ...marks, references: [...marks.references, at].sort((a, b) => a - b) };
}

export function allConfirmed(profile: Profile, marks: VesselMarks, suggested: Suggested): VesselMarks {
  return placesOf(profile, marks, suggested)
    .filter((place) => place.isSuggestion)
    .reduce(taken, marks);
}

/** A quarter of the vessel around a position, within its ends. */
export function stretchAround(profile: Profile, at: number): Pair {
  const length = lengthOf(profile);
  const from = within(at - length / 8, [0, (3 * length) / 4]);
  return [from, from + length / 4];
}

function within(value: number, [low, high]: Pair): number {
  return Math.min(Math.max(value, low), high);
}
