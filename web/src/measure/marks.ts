/** Places on a vessel that a reader marked, and those that are suggested for what is not marked yet. */
import type { Pair, Profile, Spot } from '../core/messages';
import type { VesselMarks } from '../state/document';
import { lengthOf } from './sections';

/** `place` is that of a stenosis, `diameter` one whose diameter is noted. */
export type Kind = 'place' | 'reference' | 'stretch' | 'secondStretch' | 'diameter';

export interface Place {
  readonly kind: Kind;
  /** Slot 0 lies before slot 1 along the vessel; noted diameters are numbered as they were noted. */
  readonly slot: number;
  readonly at: number;
  /** Offered by Lumencut, and no mark of a reader yet. */
  readonly isSuggestion: boolean;
  /** Of a reference: whether it lies before the stenosis, also where both lie on one side. */
  readonly isBefore?: boolean;
}

export type Suggested = readonly [Spot | null, Spot | null];
export const NOTHING_SUGGESTED: Suggested = [null, null];

/** The place of the stenosis: marked, or the narrowest one. */
export function mainPlace(profile: Profile, marks: VesselMarks): Place | null {
  const at = marks.at ?? profile.narrowest?.at ?? null;
  return at === null ? null : { kind: 'place', slot: 0, at, isSuggestion: marks.at === null };
}

/** The references before and after the stenosis. */
export function referenceSlots({ references }: VesselMarks, main: number): [number | null, number | null] {
  const [first, second] = [...references].sort((a, b) => a - b);
  if (first === undefined) {
    return [null, null];
  }
  return second !== undefined ? [first, second] : first < main ? [first, null] : [null, first];
}

/** All places of a vessel: those that are marked, and those that the engine offers beside them. */
export function placesOf(profile: Profile, marks: VesselMarks, suggested: Suggested): Place[] {
  const main = mainPlace(profile, marks);
  const references = main
    ? shownReferences(marks, main.at, suggested)
    : marks.references.map((at, slot): Place => ({ kind: 'reference', slot, at, isSuggestion: false }));
  return [...(main ? [main] : []), ...references, ...stretchEnds(marks), ...noted(marks)];
}

/** The place of the stenosis, and those that it is compared with (mm). */
export interface ComparedPlaces {
  readonly at: number;
  readonly references: readonly Place[];
}

/** Those among the places of a vessel that are compared, marked or suggested; null where there is none to compare. */
export function comparedIn(places: readonly Place[]): ComparedPlaces | null {
  const main = places.find(({ kind }) => kind === 'place');
  return main ? { at: main.at, references: places.filter(({ kind }) => kind === 'reference') } : null;
}

function shownReferences(marks: VesselMarks, main: number, suggested: Suggested): Place[] {
  const places: Place[] = [];
  referenceSlots(marks, main).forEach((at, n) => {
    const slot = n;
    const offered = suggested[n]?.at ?? null;
    if (at !== null) {
      places.push({ kind: 'reference', slot, at, isSuggestion: false, isBefore: at < main });
    } else if (offered !== null) {
      // What is marked meanwhile takes the place of an offer of before.
      places.push({ kind: 'reference', slot, at: offered, isSuggestion: true, isBefore: offered < main });
    }
  });
  return places;
}

const noted = ({ diameters }: VesselMarks): Place[] =>
  diameters.map((at, slot) => ({ kind: 'diameter', slot, at, isSuggestion: false }));

function stretchEnds(marks: VesselMarks): Place[] {
  return (['stretch', 'secondStretch'] as const).flatMap((kind) =>
    (marks[kind] ?? []).map((at, n) => ({ kind, slot: n, at, isSuggestion: false })),
  );
}

/** The marks with a place moved; a suggestion that is moved becomes a mark. Of a drag, `marks` and `place` are those of its beginning. */
export function moved(profile: Profile, marks: VesselMarks, place: Place, to: number): VesselMarks {
  const at = within(to, [0, lengthOf(profile)]);
  if (place.kind === 'place') {
    // It passes its references as they pass it: what cannot be graded there is told by the engine.
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
  // The ends keep their order, and some length between them.
  const kept: Pair =
    place.slot === 0
      ? [Math.min(at, other - LEAST_STRETCH), other]
      : [other, Math.max(at, other + LEAST_STRETCH)];
  return { ...marks, [place.kind]: kept };
}

/** One reference may pass the stenosis; where there is another on that side already, it stops at the stenosis. */
function movedReferences(profile: Profile, marks: VesselMarks, slot: number, at: number): number[] {
  const main = mainPlace(profile, marks)?.at ?? 0;
  const slots = referenceSlots(marks, main);
  const [before, other] = [slots[slot] ?? null, slots[1 - slot] ?? null];
  // Two that came from a file on one side stay free.
  const isAstray = before !== null && (slot === 0 ? before > main : before < main);
  const side: Pair = slot === 0 ? [0, main] : [main, lengthOf(profile)];
  const now = other === null || isAstray ? at : within(at, side);
  return [now, ...(other === null ? [] : [other])].sort((a, b) => a - b);
}

/** Where a place stands after it was moved from `marks` to `after`: it may have been kept from going further, or be on the other side. */
export function placeAfter(profile: Profile, marks: VesselMarks, place: Place, after: VesselMarks): Place {
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

/** The marks without a place; a suggestion stays one. A stretch goes as a whole. */
export function removed(marks: VesselMarks, place: Place): VesselMarks {
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

/** The marks with a reference at a place; one on the same side of the stenosis gives way to it. */
export function withReference(profile: Profile, marks: VesselMarks, at: number): VesselMarks {
  const main = mainPlace(profile, marks)?.at ?? 0;
  const other = referenceSlots(marks, main)[at < main ? 1 : 0];
  return { ...marks, references: [at, ...(other === null ? [] : [other])].sort((a, b) => a - b) };
}

/** The marks with a diameter noted; a second time at one place changes nothing. */
export const withDiameter = (marks: VesselMarks, at: number): VesselMarks =>
  marks.diameters.includes(at) ? marks : { ...marks, diameters: [...marks.diameters, at] };

/** Whether no further stretch can be marked. */
export const isFull = ({ stretch, secondStretch }: VesselMarks): boolean => Boolean(stretch && secondStretch);

/** The shortest stretch (mm). */
const LEAST_STRETCH = 1;

/** The marks with a stretch between two places, in either order: the first one that is free. */
export function withStretch(profile: Profile, marks: VesselMarks, one: number, other: number): VesselMarks {
  const from = within(Math.min(one, other), [0, lengthOf(profile) - LEAST_STRETCH]);
  const ends: Pair = [from, Math.max(one, other, from + LEAST_STRETCH)];
  return marks.stretch ? { ...marks, secondStretch: ends } : { ...marks, stretch: ends };
}

/** The marks with a suggestion taken as a mark, exactly where it is shown. */
export function taken(marks: VesselMarks, { kind, at }: Place): VesselMarks {
  return kind === 'place'
    ? { ...marks, at }
    : { ...marks, references: [...marks.references, at].sort((a, b) => a - b) };
}

/** The marks with all suggestions taken as marks. */
export function allConfirmed(profile: Profile, marks: VesselMarks, suggested: Suggested): VesselMarks {
  return placesOf(profile, marks, suggested)
    .filter((place) => place.isSuggestion)
    .reduce(taken, marks);
}

/** A stretch around a place: a quarter of the vessel, within it. */
export function stretchAround(profile: Profile, at: number): Pair {
  const length = lengthOf(profile);
  const from = within(at - length / 8, [0, (3 * length) / 4]);
  return [from, from + length / 4];
}

function within(value: number, [low, high]: Pair): number {
  return Math.min(Math.max(value, low), high);
}
