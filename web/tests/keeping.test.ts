/** The session is kept over a reload only if the user allows it. */
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { EMPTY } from '../src/state/document';
import { begin, change, document_, markSaved, setGiven } from '../src/state/history';
import { isKeeping, kept } from '../src/state/questions';
import { report } from '../src/state/store';
import { followKeeping } from '../src/study/unsaved';
import { reportOf, withLines } from './fake-tracing';

let held = new Map<string, string>();
const tab = {
  getItem: (key: string) => held.get(key) ?? null,
  setItem: (key: string, text: string) => void held.set(key, text),
  removeItem: (key: string) => void held.delete(key),
};
let end = () => {};
const sessions = () => [...held.values()].filter((text) => text.startsWith('session'));
const follow = () => {
  end();
  end = followKeeping(tab, async () => `session of ${document_.value.vessels.length}`);
};

beforeEach(() => {
  vi.useFakeTimers();
  held = new Map();
  report.value = reportOf([]);
  begin(EMPTY);
  follow();
});

afterEach(() => {
  end();
  vi.useRealTimers();
  report.value = null;
});

const later = () => vi.advanceTimersByTimeAsync(1500);

test('nothing is kept without permission', async () => {
  change('add', withLines(document_.value, 1));
  await later();
  expect(held.size).toBe(0);
});

test('with permission a change is kept and offered after a reload, until it is discarded', async () => {
  isKeeping.value = true;
  change('add', withLines(document_.value, 1));
  await later();
  expect(sessions()).toEqual(['session of 1']);
  begin(EMPTY);
  end();
  held.set('lumencut-session', 'session of 1');
  follow();
  expect([isKeeping.value, kept.value]).toEqual([true, 'session of 1']);
  change('add', withLines(document_.value, 1, 2));
  await later();
  expect(sessions(), 'nothing takes its place before the reader has answered').toEqual(['session of 1']);
  kept.value = null;
  await later();
  expect(sessions()).toEqual(['session of 2']);
  // A reload takes saved work from the page, too.
  markSaved(document_.value);
  await later();
  expect(sessions()).toEqual(['session of 2']);
  // Only what the files of the scan gave is not kept.
  setGiven(document_.value);
  expect(sessions()).toEqual([]);
  isKeeping.value = false;
  expect(held.size).toBe(0);
});
