/** Edits of marked places. A drag is previewed and becomes one undo step. */
import { batch, computed } from '@preact/signals';
import { moveTo } from '../state/cross-hair';
import { type Document, NO_MARKS, type VesselMarks } from '../state/document';
import { change, document_, endPreview, preview } from '../state/history';
import { answers, beginLengthAt, begunLength, dropLength, isCrossed, setCrossed } from '../state/measuring';
import { pickedPlace } from '../state/store';
import { comparedPlaces, currentMarks, currentProfile, currentVessel } from './current';
import {
  allConfirmed,
  moved,
  placeAfter,
  removed,
  taken,
  type VesselPlace,
  withDiameter,
  withMarks,
  withReference,
  withStretch,
} from './marks';
import { snapped } from './sections';
import { placeName } from './words';

interface Drag {
  readonly place: VesselPlace;
  readonly marks: VesselMarks;
  readonly document: Document;
  readonly wasCrossed: boolean;
}

let drag: Drag | null = null;

function documentWith(marks: VesselMarks): Document {
  const vessel = currentVessel.value;
  return vessel ? withMarks(document_.value, vessel.line, marks) : document_.value;
}

export function changeMarks(words: string, how: (marks: VesselMarks) => VesselMarks): void {
  const before = currentMarks.value ?? NO_MARKS;
  const after = how(before);
  if (after !== before) {
    change(words, documentWith(after));
  }
}

export function beginMove(place: VesselPlace): void {
  const marks = currentMarks.value;
  drag = marks && { place, marks, document: document_.value, wasCrossed: isCrossed.value };
}

/** Moves the dragged place to the nearest section, and the section view with it. */
export function move(to: number): void {
  const profile = currentProfile.value;
  if (profile && drag) {
    const { place, marks, wasCrossed } = drag;
    const after = moved(profile, marks, place, snapped(profile, to));
    const now = placeAfter(profile, marks, place, after);
    batch(() => {
      setCrossed(wasCrossed !== (now.slot !== place.slot));
      preview(documentWith(after));
      moveTo(now.at);
    });
  }
}

export function endMove(): void {
  if (drag) {
    endPreview(
      `move the ${placeName({ ...drag.place, isSuggestion: false, isConfirmed: false })}`,
      drag.document,
    );
    drag = null;
  }
}

export function putBack(): void {
  if (drag) {
    setCrossed(drag.wasCrossed);
    preview(drag.document);
    drag = null;
  }
}

export function markHere(kind: 'place' | 'reference'): void {
  const profile = currentProfile.value;
  if (profile) {
    const at = snapped(profile, pickedPlace.value);
    changeMarks(`mark the ${kind}`, (marks) =>
      kind === 'place' ? { ...marks, at } : withReference(profile, marks, at),
    );
  }
}

export function noteDiameter(): void {
  const profile = currentProfile.value;
  if (profile) {
    changeMarks('note a diameter', (marks) => withDiameter(marks, snapped(profile, pickedPlace.value)));
  }
}

/** Start of an unfinished length on the picked vessel (mm). */
export const lengthFrom = computed<number | null>(() =>
  begunLength.value && begunLength.value.line === currentVessel.value?.line ? begunLength.value.at : null,
);

export function beginLength(): void {
  const [vessel, profile] = [currentVessel.value, currentProfile.value];
  if (vessel && profile) {
    beginLengthAt(vessel.line, snapped(profile, pickedPlace.value));
  }
}

export function endLength(): void {
  const [from, profile] = [lengthFrom.value, currentProfile.value];
  if (from !== null && profile) {
    const to = snapped(profile, pickedPlace.value);
    changeMarks('mark a stretch', (marks) => withStretch(profile, marks, from, to));
    dropLength();
  }
}

export function confirm(place: VesselPlace): void {
  if (place.isSuggestion) {
    changeMarks(`confirm the ${placeName({ ...place, isSuggestion: false })}`, (marks) =>
      taken(marks, place),
    );
  }
}

export function confirmAll(): void {
  const profile = currentProfile.value;
  const compared = comparedPlaces.value;
  if (profile) {
    changeMarks('confirm the suggested places', (marks) =>
      allConfirmed(profile, marks, answers.value.suggested),
    );
    if (compared) {
      moveTo(compared.at);
    }
  }
}

export function remove(place: VesselPlace): void {
  changeMarks(`remove the ${placeName({ ...place, isConfirmed: false })}`, (marks) => removed(marks, place));
}
