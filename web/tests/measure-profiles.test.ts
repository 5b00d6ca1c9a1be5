/** A diameter profile is measured once and cached by line; measuring can be stopped. */

import { beforeEach, expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Asked, Message, Profile } from '../src/core/messages';
import {
  beingMeasured,
  forgetProfiles,
  giveFwhm,
  givenFwhm,
  measure,
  measureAgain,
  profiles,
  stopMeasuring,
  stopped,
} from '../src/state/profiles';
import * as store from '../src/state/store';
import { connect } from '../src/worker/engine';
import { madeProfile } from './measured';

/** A fake engine that measures only when the test says so, and records requests. */
class Fake {
  readonly asked: [number, number | null][] = [];
  answer: (profile: Profile) => void = () => undefined;
  refuse: (error: Failure) => void = () => undefined;

  ask(_: string, { line, fwhm }: Message<'profile'>) {
    this.asked.push([line, fwhm]);
    return new Promise<Profile>((resolve, reject) => {
      this.answer = resolve;
      this.refuse = reject;
    });
  }
}

let fake: Fake;
beforeEach(() => {
  fake = new Fake();
  connect(fake as unknown as Asked);
  forgetProfiles();
  givenFwhm.value = null;
  store.progress.value = null;
});

test('a line is measured once', async () => {
  const first = measure(3);
  await measure(3);
  expect(store.progress.value?.words).toBe('Measuring the vessel');
  fake.answer(madeProfile());
  await first;
  await measure(3);
  expect(fake.asked).toEqual([[3, null]]);
  expect(profiles.value.get(3)).toHaveProperty('profile');
  expect(store.progress.value).toBeNull();
});

test('the reason why a line cannot be measured is cached too', async () => {
  const asked = measure(3);
  fake.refuse(new Failure('measuring', 'vessel', 'nothing', 'lumen'));
  await asked;
  expect(profiles.value.get(3)).toHaveProperty('failure.found', 'nothing');
  await measure(3);
  expect(fake.asked).toHaveLength(1);
});

test('after a stop, a line is measured only on request', async () => {
  const asked = measure(3);
  stopMeasuring();
  expect([beingMeasured.value, stopped.value]).toEqual([null, 3]);
  fake.refuse(new Failure('interrupted', 'view', 'a stop', 'none'));
  await asked;
  expect(profiles.value.size).toBe(0);
  await measure(3);
  expect(fake.asked).toHaveLength(1);
  measureAgain();
  void measure(3);
  expect(fake.asked).toHaveLength(2);
});

test('a stop while nothing is measured does nothing', () => {
  stopMeasuring();
  expect(stopped.value).toBeNull();
});

test('an answer about another study is not cached', async () => {
  const asked = measure(3);
  forgetProfiles();
  fake.answer(madeProfile());
  await asked;
  expect(profiles.value.size).toBe(0);
});

test('with another FWHM, all vessels are measured again', async () => {
  const asked = measure(3);
  fake.answer(madeProfile());
  await asked;
  giveFwhm(0.8);
  expect(profiles.value.size).toBe(0);
  void measure(3);
  expect(fake.asked).toEqual([
    [3, null],
    [3, 0.8],
  ]);
});
