/** Rigid motions between two scans. */
import { expect, test } from 'vitest';
import { pixelOf } from '../src/core/camera';
import type { Camera, Motion, Vector } from '../src/core/messages';
import { cameraBy, inverseOf, movedBy, slicesBy } from '../src/core/motion';
import { STANDARD } from '../src/core/planes';

const MOTION: Motion = {
  rotation: [
    [0, -1, 0],
    [1, 0, 0],
    [0, 0, 1],
  ],
  shift: [5, 7, -9],
};
const POINT: Vector = [1, 2, 3];

test('a motion turns and shifts, and its inverse leads back', () => {
  expect(movedBy(MOTION, POINT)).toEqual([3, 8, -6]);
  expect(movedBy(inverseOf(MOTION), [3, 8, -6])).toEqual(POINT);
});

test('the moved camera sees a moved point at the same pixel', () => {
  const camera: Camera = {
    center: [10, 0, 4],
    direction: [0, 1, 0],
    up: [0, 0, 1],
    size: [300, 200],
    pixel_spacing: 0.5,
  };
  expect(pixelOf(cameraBy(MOTION, camera), movedBy(MOTION, POINT))).toEqual(pixelOf(camera, POINT));
});

test('moved planes show the same part of the body, and come back as the standard ones', () => {
  const there = slicesBy(MOTION, { ...STANDARD, slab: [20, 'max'] });
  expect(there.coronal).toEqual({ right: [0, 1, 0], down: [0, 0, -1] });
  expect(there.slab).toEqual([20, 'max']);
  const back = slicesBy(inverseOf(MOTION), { ...there, slab: null });
  expect(back).toBe(STANDARD);
  const unmoved: Motion = {
    ...inverseOf(MOTION),
    rotation: [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
  };
  expect(slicesBy(unmoved, structuredClone(STANDARD))).toBe(STANDARD);
});
