/** The profiles of vessels: measured when one is looked at, and kept by their lines while the study is open. */
import { batch, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Failure } from '../core/failure';
import type { LineId, Profile } from '../core/messages';
import * as store from './store';

/** A profile, or why there is none. */
export type Measured = { readonly profile: Profile } | { readonly failure: Failure };

export const profiles = signal<ReadonlyMap<LineId, Measured>>(new Map());
/** The full width at half maximum of the point spread that the user gave (mm). */
export const givenFwhm = signal<number | null>(null);
/** The line that is being measured, and the one whose measuring was stopped. */
export const beingMeasured = signal<LineId | null>(null);
export const stopped = signal<LineId | null>(null);

/** Counts what was asked: answers to questions of a former study or another width are not kept. */
let asked = 0;

/** Measures a line, unless it is measured already. */
export async function measure(engine: Asked, line: LineId): Promise<void> {
  if (profiles.value.has(line) || beingMeasured.value !== null || stopped.value === line) {
    return;
  }
  const question = ++asked;
  beingMeasured.value = line;
  const found = await profileOf(engine, line, question);
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

/** The profile of a line, measured where it is not known yet. */
export async function profileOfLine(engine: Asked, line: LineId): Promise<Profile> {
  const known = profiles.value.get(line);
  if (known) {
    if ('failure' in known) {
      throw known.failure;
    }
    return known.profile;
  }
  return engine.ask('profile', { line, fwhm: givenFwhm.value });
}

/** The profile, or why there is none; nothing where it was stopped. */
async function profileOf(engine: Asked, line: LineId, question: number): Promise<Measured | null> {
  try {
    tell(question, null);
    const profile = await engine.ask('profile', { line, fwhm: givenFwhm.value });
    tell(question, 1);
    return { profile };
  } catch (error) {
    const failure = Failure.of(error);
    return failure.kind === 'interrupted' ? null : { failure };
  }
}

/** Tells that a vessel is being measured, or that it is; without a total it is not known how long it takes. */
function tell(question: number, total: number | null): void {
  if (question === asked) {
    store.progress.value = { words: 'measuring the vessel', done: total ?? 0, total };
  }
}

/** Measures what was stopped after all. */
export function measureAgain(): void {
  stopped.value = null;
}

/** Reckons with another width of the point spread from now on: all is measured again. */
export function giveFwhm(fwhm: number | null): void {
  batch(() => {
    forgetProfiles();
    givenFwhm.value = fwhm;
  });
}

/** What is being measured was cancelled: it is not begun again by itself. */
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

/** Another study, or none: another scanner may have made it. */
export const beginMeasuring = (): void => giveFwhm(null);

/** Nothing is known any longer, as of other vessels. */
export function forgetProfiles(): void {
  asked += 1;
  batch(() => {
    profiles.value = new Map();
    beingMeasured.value = null;
    stopped.value = null;
  });
}
