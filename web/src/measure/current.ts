/** The picked vessel, its diameter profile, its marks and its measurements. */
import { computed } from '@preact/signals';
import type { Failure } from '../core/failure';
import type { LineId, Profile } from '../core/messages';
import type { VesselMarks } from '../state/document';
import { document_ } from '../state/history';
import { answers } from '../state/measuring';
import { profiles } from '../state/profiles';
import * as store from '../state/store';
import { type ComparedPlaces, comparedIn, marksOf, placesOf, type VesselPlace } from './marks';

export interface CurrentVessel {
  readonly line: LineId;
  /** Name of the vessel, or its number (from 1) if it has none. */
  readonly name: string;
  readonly length: number;
}

export const currentVessel = computed<CurrentVessel | null>(() => {
  const number = store.pickedVessel.value;
  const vessel = number === null ? undefined : store.report.value?.vessels?.[number];
  return vessel && number !== null
    ? { line: vessel.line, name: vessel.name || `vessel ${number + 1}`, length: vessel.length }
    : null;
});

const measured = computed(() => {
  const vessel = currentVessel.value;
  return vessel ? (profiles.value.get(vessel.line) ?? null) : null;
});

export const currentProfile = computed<Profile | null>(() => {
  const found = measured.value;
  return found && 'profile' in found ? found.profile : null;
});

export const currentFailure = computed<Failure | null>(() => {
  const found = measured.value;
  return found && 'failure' in found ? found.failure : null;
});

export const currentMarks = computed<VesselMarks | null>(() => {
  const vessel = currentVessel.value;
  return vessel && marksOf(document_.value, vessel.line);
});

/** Marked and suggested places; empty before the vessel is measured. */
export const currentPlaces = computed<readonly VesselPlace[]>(() => {
  const [profile, marks] = [currentProfile.value, currentMarks.value];
  return profile && marks ? placesOf(profile, marks, answers.value.suggested) : [];
});

/** The narrowest place and its references, marked or suggested. */
export const comparedPlaces = computed<ComparedPlaces | null>(() => comparedIn(currentPlaces.value));
