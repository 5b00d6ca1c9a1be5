/** Axes, curves and flags of the diameter chart, and the vessel above it on the same axis. */
import { describe, expect, test } from 'vitest';
import { axisAlong, chartLayout, LEFT, RIGHT } from '../src/measure/chart-layout';
import { bandPath, counted, isolated, linePath, spreadOf, stretches, topOf } from '../src/measure/curves';
import { flagsIn, runs } from '../src/measure/flags';
import { lyingBox, lyingIn, lyingPicture } from '../src/measure/lying';
import { pixelAt, ticks, valueAt } from '../src/measure/scale';
import { fittingSide } from '../src/measure/sections';
import { madeProfile } from './measured';

const AXIS = { low: 0, high: 60, start: 50, end: 650 };

describe('an axis', () => {
  test('converts lengths to pixels and back', () => {
    expect(pixelAt(AXIS, 0)).toBe(50);
    expect(pixelAt(AXIS, 30)).toBe(350);
    expect(valueAt(AXIS, pixelAt(AXIS, 12.5))).toBeCloseTo(12.5, 12);
  });

  test('ends at the end of the vessel', () => {
    expect(valueAt(AXIS, -1000)).toBe(0);
    expect(valueAt(AXIS, 5000)).toBe(60);
  });

  test('may point upwards', () => {
    const up = { low: 0, high: 10, start: 200, end: 20 };
    expect(pixelAt(up, 10)).toBe(20);
    expect(valueAt(up, 110)).toBeCloseTo(5, 12);
  });
});

describe('ticks', () => {
  test.each([
    [0, 60, 6, [0, 10, 20, 30, 40, 50, 60]],
    [0, 60, 5, [0, 20, 40, 60]],
    [0, 9.4, 5, [0, 2, 4, 6, 8]],
    [0, 0.7, 4, [0, 0.2, 0.4, 0.6]],
    [12, 118, 4, [50, 100]],
  ])('from %d to %d, %d at most', (low, high, most, expected) => {
    expect(ticks(low, high, most)).toEqual(expected);
  });

  test('there are none on an axis without length', () => {
    expect(ticks(3, 3, 5)).toEqual([]);
    expect(ticks(0, Number.NaN, 5)).toEqual([]);
  });
});

describe('curves', () => {
  const axes = [
    { low: 0, high: 4, start: 0, end: 4 },
    { low: 0, high: 10, start: 10, end: 0 },
  ] as const;
  const places = [0, 1, 2, 3, 4];

  test('are interrupted at sections that are left out', () => {
    expect(stretches([1, 2, null, 3, null])).toEqual([[0, 1], [3]]);
    expect(linePath(...axes, places, [1, 2, null, 3, 4])).toBe('M0.00 9.00L1.00 8.00M3.00 7.00L4.00 6.00');
  });

  test('single sections are dots', () => {
    expect(isolated([1, null, 2, null, null])).toEqual([0, 2]);
    expect(linePath(...axes, places, [1, null, 2, null, null])).toBe('');
  });

  test('a band runs forth along its upper edge and back along its lower edge', () => {
    const path = bandPath(...axes, places, [
      [1, 1, null, null, null],
      [2, 3, 4, null, null],
    ]);
    expect(path).toBe('M0.00 8.00L1.00 7.00L1.00 9.00L0.00 9.00Z');
  });

  test('the band extends two standard deviations to both sides', () => {
    const profile = madeProfile();
    const [low, high] = spreadOf(profile);
    expect(low[20]).toBeCloseTo(7.8, 12);
    expect(high[20]).toBeCloseTo(8.2, 12);
    expect(low[118]).toBeNull();
  });

  test('the largest valid diameter fits in the chart', () => {
    expect(topOf(madeProfile())).toBeCloseTo(1.12 * 8.8, 12);
    const none = { ...madeProfile(), counts: madeProfile().counts.map(() => false) };
    expect(topOf(none)).toBeCloseTo(1.12 * 8.8, 12);
    expect(counted(none, none.diameter).every((value) => value === null)).toBe(true);
    expect(topOf({ ...none, diameter_max: none.diameter_max.map(() => null) })).toBe(1);
  });
});

describe('flags', () => {
  test('each flag that occurs has a row, in the order of the Python package', () => {
    expect(flagsIn(madeProfile()).map(({ word }) => word)).toEqual(['branch', 'calcium']);
  });

  test('runs extend half a section distance beyond their sections', () => {
    expect(runs(madeProfile(), 'calcium')).toEqual([[18.75, 21.25]]);
    expect(runs(madeProfile(), 'branch')).toEqual([[50.25, 60.25]]);
    expect(runs(madeProfile(), 'metal')).toEqual([]);
  });

  test('two stretches are two runs', () => {
    const profile = madeProfile(4);
    const flags = profile.flags.map((_, n) => (n === 1 || n === 3 ? ['metal'] : []));
    expect(runs({ ...profile, flags }, 'metal')).toEqual([
      [0.25, 0.75],
      [1.25, 1.75],
    ]);
  });
});

describe('the labels of flags', () => {
  const profile = madeProfile();
  const words = profile.flag_table.map(({ word }) => word);
  const flagged = { ...profile, flags: profile.flags.map(() => words) };

  test('stand beside the rows if these are high enough', () => {
    const { row, wordRow } = chartLayout(flagged, [900, 500]);
    expect(wordRow).toBe(row);
  });

  test('extend upwards beside the curve if rows are lower than letters', () => {
    const { row, wordRow, bottom, y } = chartLayout(flagged, [900, 140]);
    expect(row).toBeLessThan(9);
    expect(wordRow).toBe(11);
    expect(bottom - words.length * wordRow).toBeGreaterThan(y.end);
  });
});

describe('the horizontal vessel', () => {
  const size = [900, 260] as const;

  test('has the axis of the chart', () => {
    expect(chartLayout(madeProfile(), size).x).toEqual(axisAlong(60, 900));
    expect(axisAlong(60, 900)).toEqual({ low: 0, high: 60, start: LEFT, end: 900 - RIGHT });
  });

  test('the centre of each column is at the arc length of its row in the CPR', () => {
    const x = axisAlong(60, 900);
    const lying = lyingIn(x, { height: 150, density: 2, fitting: 22 });
    // The picture of the engine has a row every `spacing` mm, starting at the first point of the vessel.
    const columns = Math.floor(60 / lying.spacing + 1e-9) + 1;
    const box = lyingBox(x, lying, [columns, 41]);
    const pixel = box.width / columns;
    for (const n of [0, 100, columns - 1]) {
      expect(box.left + (n + 0.5) * pixel).toBeCloseTo(pixelAt(x, n * lying.spacing), 9);
    }
  });

  test('a long vessel is true to scale, a short one shows at least its lumen', () => {
    const long = lyingIn(axisAlong(400, 900), { height: 150, density: 1, fitting: 22 });
    expect(long.stretch).toBeCloseTo(1, 12);
    const short = lyingIn(axisAlong(40, 900), { height: 150, density: 1, fitting: 60 });
    expect(short.width).toBe(36);
    expect(short.stretch).toBeLessThan(0.5);
    expect(short.height).toBe(150);
  });

  test('the first row of the CPR becomes the first column, its last column the first row', () => {
    const pixels = new Uint32Array([1, 2, 3, 4, 5, 6]);
    const picture = { size: [2, 3] as const, bytes: new Uint8ClampedArray(pixels.buffer) };
    const { size: turned, bytes } = lyingPicture(picture);
    expect(turned).toEqual([3, 2]);
    expect([...new Uint32Array(bytes.buffer)]).toEqual([2, 4, 6, 1, 3, 5]);
  });

  test('pictures of sections fit all valid lumens', () => {
    expect(fittingSide(madeProfile())).toBe(22);
    const nothing = madeProfile().diameter_max.map(() => null);
    expect(fittingSide({ ...madeProfile(), diameter_max: nothing })).toBe(30);
  });
});
