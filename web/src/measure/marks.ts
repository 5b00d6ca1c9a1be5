/** Marked places of a vessel, and suggestions for those not yet marked. */
import type { LineId, Pair, Profile } from '../core/messages';
import { type Document, NO_MARKS, type VesselMarks } from '../state/document';
import type { Suggested } from '../state/measuring';
import { lengthOf } from './sections';

/** Kinds of marks: `place` is the stenosis, `diameter` a noted diameter. */
export type Kind = 'place' | 'reference' | 'stretch' | 'secondStretch' | 'diameter';

export interface VesselPlace {
  readonly kind: Kind;
  /** 0 or 1 for the first or second of two places along the vessel; noted diameters are numbered in order of entry. */
  readonly slot: number;
  readonly at: number;
  /** Whether Lumencut suggested the place, and the user has not marked it. */
  readonly isSuggestion: boolean;
  /** Whether the mark is a suggestion that the user confirmed and has not moved since. */
  readonly isConfirmed?: boolean;
  /** For a reference: whether it is shown as the one before the stenosis, also if both lie on one side. */
  readonly isBefore?: boolean;
}

export function mainPlace(profile: Profile, marks: VesselMarks): VesselPlace | null {
  const at = marks.at ?? profile.narrowest?.at ?? profile.throat ?? null;
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
  const compared = [...(main ? [main] : []), ...references].map((place) => ({
    ...place,
    isConfirmed: !place.isSuggestion && marks.confirmed.includes(place.at),
  }));
  return [...compared, ...stretchEnds(marks), ...noted(marks)];
}

export interface ComparedPlaces {
  readonly at: number;
  readonly references: readonly VesselPlace[];
}

/** The stenosis and its references; null without a stenosis. */
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

/** Moves a place; a moved suggestion becomes a mark. During a drag, `marks` and `place` are those before the drag. */
export function moved(profile: Profile, marks: VesselMarks, place: VesselPlace, to: number): VesselMarks {
  const at = within(to, [0, lengthOf(profile)]);
  if (place.kind === 'place') {
    // The stenosis may be moved past its references; then the engine reports why it cannot grade it.
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
  // The two ends keep their order and a minimum distance.
  const kept: Pair =
    place.slot === 0
      ? [Math.min(at, other - LEAST_STRETCH), other]
      : [other, Math.max(at, other + LEAST_STRETCH)];
  return { ...marks, [place.kind]: kept };
}

/** Moves a reference. It may pass the stenosis unless the other reference lies on that side. */
function movedReferences(profile: Profile, marks: VesselMarks, slot: number, at: number): number[] {
  const main = mainPlace(profile, marks)?.at ?? 0;
  const slots = referenceSlots(marks, main);
  const [before, other] = [slots[slot] ?? null, slots[1 - slot] ?? null];
  // If both references of a loaded session lie on one side, they move freely.
  const areOnOneSide = before !== null && (slot === 0 ? before > main : before < main);
  const side: Pair = slot === 0 ? [0, main] : [main, lengthOf(profile)];
  const now = other === null || areOnOneSide ? at : within(at, side);
  return [now, ...(other === null ? [] : [other])].sort((a, b) => a - b);
}

/** The place after a move, which may have been limited, or have crossed the stenosis. */
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

/** Removes a marked place; for an end of a stretch, the whole stretch. Suggestions cannot be removed. */
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

/** Adds a reference, which replaces the one on the same side of the stenosis. */
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

/** Marks a suggested place at its exact position. */
export function taken(marks: VesselMarks, { kind, at }: VesselPlace): VesselMarks {
  const confirmed = [...marks.confirmed.filter((one) => one !== at), at];
  return kind === 'place'
    ? { ...marks, at, confirmed }
    : { ...marks, confirmed, references: [...marks.references, at].sort((a, b) => a - b) };
}

export function allConfirmed(profile: Profile, marks: VesselMarks, suggested: Suggested): VesselMarks {
  return placesOf(profile, marks, suggested)
    .filter((place) => place.isSuggestion)
    .reduce(taken, marks);
}

/** A stretch around a position, a quarter as long as the vessel and within its ends. */
export function stretchAround(profile: Profile, at: number): Pair {
  const length = lengthOf(profile);
  const from = within(at - length / 8, [0, (3 * length) / 4]);
  return [from, from + length / 4];
}

function within(value: number, [low, high]: Pair): number {
  return Math.min(Math.max(value, low), high);
}

const byLine = (document: Document, line: LineId) => document.vessels.find((vessel) => vessel.line === line);

export function marksOf(document: Document, line: LineId): VesselMarks {
  const vessel = byLine(document, line);
  return (vessel && document.marks[vessel.id]) ?? NO_MARKS;
}

export function withMarks(document: Document, line: LineId, marks: VesselMarks): Document {
  const id = byLine(document, line)?.id;
  return id === undefined ? document : { ...document, marks: { ...document.marks, [id]: marks } };
}
