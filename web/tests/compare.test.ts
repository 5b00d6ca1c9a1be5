/** The picture comparison of the browser tests detects wrong pictures. */
import { expect, test } from 'vitest';
import {
  difference,
  isEmpty,
  OTHER_DEVICE,
  OTHER_DEVICE_WITH_CONTEXT,
  type Pixels,
  SAME_CODE,
} from '../e2e/compare';

const WIDTH = 64;

function ramp(changes: Readonly<Record<number, number>> = {}): Pixels {
  const bytes = Uint8Array.from({ length: WIDTH * WIDTH * 4 }, (_, n) => (changes[n] ?? 0) + (n % 200));
  return { width: WIDTH, height: WIDTH, bytes };
}

test('a picture equals itself, also if a channel differs by one step', () => {
  expect(difference(ramp(), ramp(), SAME_CODE)).toBeNull();
  expect(difference(ramp({ 5: 1, 77: -1 }), ramp(), SAME_CODE)).toBeNull();
});

test('a single channel that differs by two steps is detected', () => {
  expect(difference(ramp({ 5: 2 }), ramp(), SAME_CODE)).toContain('1 of 16384 channels');
  expect(difference(ramp({ 16383: 2 }), ramp(), SAME_CODE)).toContain('at most 2');
});

test('another device may differ in a few channels, but not in many', () => {
  const changed = (count: number, by: number) =>
    ramp(Object.fromEntries(Array.from({ length: count }, (_, n) => [n * 40, by])));
  expect(difference(changed(1, 50), ramp(), OTHER_DEVICE)).toBeNull();
  expect(difference(changed(2, 50), ramp(), OTHER_DEVICE)).toContain('further apart than 4');
  expect(difference(changed(8, 4), ramp(), OTHER_DEVICE)).toBeNull();
  expect(difference(changed(9, 4), ramp(), OTHER_DEVICE)).toContain('further apart than 1');
  expect(difference(changed(16, 50), ramp(), OTHER_DEVICE_WITH_CONTEXT)).toBeNull();
  expect(difference(changed(17, 50), ramp(), OTHER_DEVICE_WITH_CONTEXT)).toContain('further apart than 4');
});

test('another size is detected, and so is a picture with too few bytes', () => {
  const wide: Pixels = { ...ramp(), width: 2 * WIDTH, height: WIDTH / 2 };
  expect(difference(wide, ramp(), SAME_CODE)).toContain('128 × 32');
  const short: Pixels = { ...ramp(), bytes: ramp().bytes.slice(4) };
  expect(difference(short, ramp(), SAME_CODE)).not.toBeNull();
});

test('a picture of one colour is empty', () => {
  const bytes = Uint8Array.from({ length: WIDTH * WIDTH * 4 }, (_, n) => n % 4);
  expect(isEmpty({ width: WIDTH, height: WIDTH, bytes })).toBe(true);
  expect(isEmpty(ramp())).toBe(false);
});
