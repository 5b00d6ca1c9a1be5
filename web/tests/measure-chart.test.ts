/** Axes of a profile, with the horizontal vessel on the same axis. */
import { describe, expect, test } from 'vitest';
import { lyingBox, lyingPicture, pixelAt, valueAt } from '../src/measure/layout';

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

describe('the lying vessel', () => {
  test('the middle of each column is at the arc length of its row in the CPR', () => {
    const x = { low: 0, high: 60, start: 56, end: 796 };
    const lying = { width: 22, spacing: 60 / 740 / 2, height: 150, stretch: 0.55 };
    // The engine's layout: a row every `spacing` mm, starting at the first point.
    const columns = Math.floor(60 / lying.spacing + 1e-9) + 1;
    const box = lyingBox(x, lying, [columns, 41]);
    const pixel = box.width / columns;
    for (const n of [0, 100, columns - 1]) {
      expect(box.left + (n + 0.5) * pixel).toBeCloseTo(pixelAt(x, n * lying.spacing), 9);
    }
  });

  test('its first row is its first column, its last column its first row', () => {
    const pixels = new Uint32Array([1, 2, 3, 4, 5, 6]);
    const picture = { size: [2, 3] as const, bytes: new Uint8ClampedArray(pixels.buffer) };
    const { size: turned, bytes } = lyingPicture(picture);
    expect(turned).toEqual([3, 2]);
    expect([...new Uint32Array(bytes.buffer)]).toEqual([2, 4, 6, 1, 3, 5]);
  });
});
