/** Diameter profiles of vessels, measured on demand and cached by line until the study closes. */

import { batch, signal } from '@preact/signals';
import { Failure } from '../core/failure';
import type { LineId, Profile } from '../core/messages';
import { engine } from '../worker/engine';
import * as store from './store';

export type Measured = { readonly profile: Profile } | { readonly failure: Failure };

export const profiles = signal<ReadonlyMap<LineId, Measured>>(new Map());
/** FWHM of the point spread function entered by the user (mm). */
export const givenFwhm = signal<number | null>(null);
export const beingMeasured = signal<LineId | null>(null);
export const stopped = signal<LineId | null>(null);

/** Number of the latest request. Answers to earlier ones, for another study or FWHM, are dropped. */
let asked = 0;

/** Measures a line, unless its profile is known or another line is being measured. */
export async function measure(line: LineId): Promise<void> {
  if (profiles.value.has(line) || beingMeasured.value !== null || stopped.value === line) {
    return;
  }
  const question = ++asked;
  beingMeasured.value = line;
  const found = await profileOf(line, question);
  if (question !== asked) {
    return;
  }
  batch(() => {
    beingMeasured.value = null;
    store.progress.value = null;
    if (found) {
      profiles.value = new Map(profiles.value).set(line, found);
    } else {
      stopped.value = line;
    }
  });
}

export async function profileOfLine(line: LineId): Promise<Profile> {
  const known = profiles.value.get(line);
  if (known) {
    if ('failure' in known) {
      throw known.failure;
    }
    return known.profile;
  }
  return engine.ask('profile', { line, fwhm: givenFwhm.value });
}

/** Replaces the known profile of a line after a contour of it was drawn by hand. */
export async function renewProfile(line: LineId): Promise<void> {
  const question = asked;
  const profile = await engine.ask('profile', { line, fwhm: givenFwhm.value });
  if (question === asked && profiles.value.has(line)) {
    profiles.value = new Map(profiles.value).set(line, { profile });
  }
}

async function profileOf(line: LineId, question: number): Promise<Measured | null> {
  try {
    showProgress(question, null);
    const profile = await engine.ask('profile', { line, fwhm: givenFwhm.value });
    showProgress(question, 1);
    return { profile };
  } catch (error) {
    const failure = Failure.of(error);
    return failure.kind === 'interrupted' ? null : { failure };
  }
}

/** Shows the progress; a null `total` means that the duration is unknown. */
function showProgress(question: number, total: number | null): void {
  if (question === asked) {
    store.progress.value = { words: 'Measuring the vessel', done: total ?? 0, total };
  }
}

export function measureAgain(): void {
  stopped.value = null;
}

/** Sets the FWHM that the user entered. All vessels are then measured again. */
export function giveFwhm(fwhm: number | null): void {
  batch(() => {
    forgetProfiles();
    givenFwhm.value = fwhm;
  });
}

/** Cancels the current measurement. It does not restart by itself. */
export function stopMeasuring(): void {
  if (beingMeasured.value !== null) {
    asked += 1;
    batch(() => {
      stopped.value = beingMeasured.value;
      beingMeasured.value = null;
      store.progress.value = null;
    });
  }
}

/** Forgets the entered FWHM, since a new study may come from another scanner. */
export const beginMeasuring = (): void => giveFwhm(null);

export function forgetProfiles(): void {
  asked += 1;
  batch(() => {
    profiles.value = new Map();
    beingMeasured.value = null;
    stopped.value = null;
  });
}
