/** What one page shows when the user operates the page with the other scan. */
import { beforeEach, expect, test } from 'vitest';
import { LINKS, type OtherScan, type Seen } from '../src/core/linked';
import type { Motion, Report, ScansToCompare } from '../src/core/messages';
import { STANDARD } from '../src/core/planes';
import * as store from '../src/state/store';
import {
  across,
  addPair,
  atAcross,
  beginScans,
  comparison,
  endComparison,
  isOtherEarlier,
  isSameScan,
  keepComparison,
  linkAll,
  links,
  pairs,
  savedComparison,
  setOtherEarlier,
  setPlaced,
  takeOther,
  toggleLink,
} from '../src/state/two-scans';

const IDENTITY: Motion['rotation'] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
const shifted = (z: number): Motion => ({ rotation: IDENTITY, shift: [0, 0, z] });

const OTHER: OtherScan = {
  count: 1,
  name: 'earlier',
  grid: { size: [2, 3, 4], world_from_index: [[1, 0, 0, 0]] },
  values: '[1,2]',
  corners: [],
  lines: [7],
  isHounsfield: true,
  size: '300x200',
};

const SEEN: Seen = {
  windows: [300, 900],
  'cross-hairs': { point: [1, 2, 3], line: 4, at: 10 },
  slices: STANDARD,
  layouts: 'four',
};

/** The other scan is the earlier one; its vessel begins 5 mm later, and ends at 20 mm. */
function compared(): void {
  const places = [0, 1, 2, 20].map((at): [number, number | null] => [at, at < 20 ? at + 5 : null]);
  const answer = {
    sentences: [],
    places,
    motion: shifted(100),
    chart: '',
    axis: { low: 0, high: 20, start: 0, end: 100 },
  };
  endComparison({ asked: {} as ScansToCompare, answer, lines: [4, 7], isOtherEarlier: true });
}

beforeEach(() => {
  const vessels = [{ line: 4, name: 'ICA', length: 30, has_radius: true }];
  store.report.value = { volume: null, vessels, windows: { is_hounsfield: true } } as unknown as Report;
  takeOther(null);
  takeOther(OTHER);
  setPlaced(shifted(50));
  linkAll(true);
});

test('a place moves with the scan, and the window is the same', () => {
  expect(across(SEEN, false)).toEqual({
    ...SEEN,
    'cross-hairs': { point: [1, 2, 53], line: null, at: null },
  });
  expect(across(SEEN, true)['cross-hairs']?.point).toEqual([1, 2, -47]);
});

test('nothing is linked before the position of the other scan is known', () => {
  beginScans();
  expect(across(SEEN, false)).toEqual({});
});

test('each part can be unlinked, and all at once', () => {
  toggleLink('windows');
  expect(across(SEEN, false).windows).toBeUndefined();
  toggleLink('windows');
  expect(Object.keys(across(SEEN, false)).length).toBe(4);
  linkAll(false);
  expect(across(SEEN, false)).toEqual({});
  linkAll(true);
  expect(links.value).toEqual(LINKS);
});

test('a window in HU means nothing to a scan without HU', () => {
  takeOther({ ...OTHER, isHounsfield: false });
  expect(across(SEEN, false).windows).toBeUndefined();
});

test('on a compared vessel, the place is that of the same arc length from either side', () => {
  compared();
  expect(atAcross(6.2, false)).toBe(1);
  expect(atAcross(1, true)).toBe(6);
  expect(atAcross(20, true)).toBeNull();
  expect(atAcross(12, false)).toBeNull();
  const place = { point: [1, 2, 3], line: 4, at: 6 } as const;
  expect(across({ 'cross-hairs': place }, false)['cross-hairs']).toEqual({
    point: [1, 2, -97],
    line: 7,
    at: 1,
  });
});

test('a comparison ends with one of its vessels, or with one of its scans', () => {
  compared();
  expect(comparison.value).not.toBeNull();
  takeOther({ ...OTHER, lines: [8] });
  expect(comparison.value).toBeNull();
  takeOther(OTHER);
  expect(comparison.value).not.toBeNull();
  takeOther({ ...OTHER, count: 2 });
  expect(comparison.value).toBeNull();
});

test('a session keeps order and pairs until its other scan is open again', () => {
  setOtherEarlier(false);
  addPair([1, 2, 3], [4, 5, 6]);
  const saved = savedComparison() ?? undefined;
  expect(saved).toEqual({
    scan: OTHER.grid,
    is_earlier: false,
    pairs_mm: [
      [
        [1, 2, 3],
        [4, 5, 6],
      ],
    ],
  });
  takeOther(null);
  setOtherEarlier(true);
  expect(keepComparison(structuredClone(saved))).toBe(false);
  expect(savedComparison()).toEqual(saved);
  takeOther({ ...OTHER, count: 2, grid: { ...OTHER.grid, size: [9, 9, 9] } });
  expect([isOtherEarlier.value, pairs.value]).toEqual([true, []]);
  takeOther({ ...OTHER, count: 3 });
  expect([isOtherEarlier.value, pairs.value]).toEqual([false, saved?.pairs_mm]);
  expect(keepComparison(undefined)).toBe(true);
  takeOther(null);
  expect(savedComparison()).toBeNull();
  keepComparison(saved);
  store.report.value = { volume: {}, vessels: [], windows: null } as unknown as Report;
  expect(savedComparison()).toBeNull();
});

test('a scan next to itself is recognised by its grid and values', () => {
  const volume = OTHER.grid as unknown as Report['volume'];
  store.report.value = { volume, vessels: [], windows: null } as unknown as Report;
  const histogram = (counts: number[]) =>
    ({ low: 0, high: 1, counts }) as unknown as typeof store.histogram.value;
  store.histogram.value = histogram([3, 4]);
  takeOther({ ...OTHER, values: JSON.stringify(histogram([3, 4])) });
  expect(isSameScan.value).toBe(true);
  store.histogram.value = histogram([3, 5]);
  expect(isSameScan.value).toBe(false);
  store.histogram.value = null;
});
