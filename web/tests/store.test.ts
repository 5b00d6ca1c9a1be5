import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, expect, test } from 'vitest';
import type { Pair, Report, Window } from '../src/core/messages';
import { choosePreset, dragWindow, windowBack } from '../src/state/actions';
import { begin, change, document_, hasEdits, redo, undo, undoWords } from '../src/state/history';
import * as store from '../src/state/store';
import { expectNear } from './helpers';

const WINDOWS = {
  main: [300, 900],
  contexts: { mida: [300, 900], mip: [400, 600], minip: [0, 2000] },
  presets: [
    { name: 'auto', words: 'From the data', window: [300, 900] },
    { name: 'soft-tissue', words: 'Soft tissue', window: [40, 400] },
  ],
} as const;

afterEach(() => {
  store.report.value = null;
  store.settings.value = {};
  store.window_.value = [300, 900];
});

test('while the user has not changed the window, other windows stay the same', () => {
  expect(store.moved([400, 600], [300, 900], [300, 900])).toEqual([400, 600]);
});

test('a separate window is moved and widened with the main one', () => {
  expectNear(store.moved([400, 600], [300, 900], [350, 900]), [450, 600]);
  expectNear(store.moved([400, 600], [300, 900], [300, 1800]), [500, 1200]);
  expectNear(store.moved([300, 900], [300, 900], [-12, 77]), [-12, 77]);
});

test('each context has its own window', () => {
  store.report.value = { volume: null, vessels: null, windows: WINDOWS } as unknown as Report;
  const windowOf = (context: string | null) => {
    store.settings.value = { context };
    return store.viewSettings.value.context_window;
  };
  expect(windowOf('mida')).toEqual([300, 900]);
  expect(windowOf('mip')).toEqual([400, 600]);
  expect(windowOf('minip')).toEqual([0, 2000]);
  expect(windowOf(null)).toBeUndefined();
  store.settings.value = {};
  store.window_.value = [320, 900];
  expect(store.viewSettings.value).toEqual({ window: [320, 900], context_window: [320, 900] });
  store.window_.value = [-600, 1500];
  expect(windowOf('minip'), 'a chosen window shows the smallest values too').toEqual([-600, 1500]);
});

test('a preset has the window of its number; without a volume there is none', () => {
  choosePreset(1);
  expect(store.window_.value).toEqual([300, 900]);
  store.report.value = { volume: null, vessels: null, windows: WINDOWS } as unknown as Report;
  choosePreset(1);
  expect(store.window_.value).toEqual([40, 400]);
  choosePreset(7);
  expect(store.window_.value).toEqual([40, 400]);
});

test('a drag of the window is a separate undo step between those of the document', () => {
  const [empty, changed] = [document_.value, { ...document_.value, bridge: true }];
  begin(empty);
  store.window_.value = [300, 900];
  change('name a vessel', changed);
  const drag = windowBack();
  drag.begin();
  dragWindow([10, 0]);
  dragWindow([10, 5]);
  drag.end();
  const after = store.window_.value;
  expect(after).not.toEqual([300, 900]);
  expect(undoWords.value).toBe('change the window');
  undo();
  expect(store.window_.value).toEqual([300, 900]);
  expect(document_.value).toBe(changed);
  expect(undoWords.value).toBe('name a vessel');
  redo();
  expect(store.window_.value).toEqual(after);
  undo();
  undo();
  expect(document_.value).toBe(empty);
  begin(empty);
});

test('a drag is no undo step if it changes no window, or if Escape undoes it', () => {
  begin(document_.value);
  const drag = windowBack();
  drag.begin();
  drag.end();
  expect(undoWords.value).toBeNull();
  drag.begin();
  dragWindow([10, 0]);
  drag.putBack();
  expect(store.window_.value).toEqual([300, 900]);
  expect(undoWords.value).toBeNull();
});

test('a change of the window is not an edit of the vessels', () => {
  begin(document_.value);
  store.report.value = { volume: null, vessels: null, windows: WINDOWS } as unknown as Report;
  choosePreset(1);
  expect(undoWords.value).toBe('change the window');
  expect(hasEdits.value).toBe(false);
  change('name a vessel', { ...document_.value, bridge: true });
  expect(hasEdits.value).toBe(true);
  begin({ ...document_.value });
});

/** Windows after drags, which the tests of Rust and Python read too. */
test('a drag changes the window as in all hosts', () => {
  const text = readFileSync(join(import.meta.dirname, '../../tests/drags.json'), 'utf-8');
  const { windows } = JSON.parse(text) as { windows: { window: Window; drag: Pair; end: Window }[] };
  for (const { window, drag, end } of windows) {
    store.window_.value = window;
    dragWindow(drag);
    expect(store.window_.value).toEqual(end);
  }
});
