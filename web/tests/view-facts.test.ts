/** What views tell beside their pictures: scale, unit and lines. */
import { afterEach, expect, test } from 'vitest';
import type { Report } from '../src/core/messages';
import { lines } from '../src/state/looks';
import * as store from '../src/state/store';
import { valueUnit } from '../src/state/value-unit';
import { fits } from '../src/views/EdgeLabels';
import { reportOf } from './fake-tracing';

afterEach(() => {
  store.report.value = null;
  store.settings.value = {};
});

test('a scale bar whose label would be cut off is left out', () => {
  expect([fits(60, 82), fits(20, 82), fits(20, 60), fits(300, 220)]).toEqual([true, true, false, false]);
});

test('a value has a unit, or the page states that none is known', () => {
  expect(valueUnit()).toBe('(no unit stated)');
  store.report.value = { ...reportOf([]), windows: { is_hounsfield: true } as Report['windows'] };
  expect(valueUnit()).toBe('HU');
});

test('more than 40 vessels are shown without lines, unless the user chooses lines', () => {
  const vessels = Array.from({ length: 41 }, (_, line) => ({ line, name: '' }));
  store.report.value = reportOf(vessels.slice(1));
  expect(store.viewSettings.value.silhouettes).toBeUndefined();
  store.report.value = reportOf(vessels);
  expect([store.viewSettings.value.silhouettes, lines.value]).toEqual([false, 'none']);
  store.settings.value = { silhouettes: true };
  expect(store.viewSettings.value.silhouettes).toBe(true);
});
