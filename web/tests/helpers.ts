/** Shared test helpers. */
import { expect } from 'vitest';
import type { Camera, Vector } from '../src/core/messages';
import { cross, dot, length } from '../src/core/vectors';

export const CAMERA: Camera = {
  center: [10, -20, 30],
  direction: [0, 1, 0],
  up: [0, 0, 1],
  size: [400, 300],
  pixel_spacing: 0.5,
};

export function expectNear(found: readonly number[], expected: readonly number[], digits = 9): void {
  expect(found).toHaveLength(expected.length);
  found.forEach((part, n) => {
    expect(part).toBeCloseTo(expected[n] ?? Number.NaN, digits);
  });
}

export function expectOrthonormal(direction: Vector, up: Vector, digits = 12): void {
  expect(length(direction)).toBeCloseTo(1, digits);
  expect(length(up)).toBeCloseTo(1, digits);
  expect(dot(direction, up)).toBeCloseTo(0, digits);
  expect(length(cross(direction, up))).toBeCloseTo(1, digits);
}

/** Reproducible numbers in [0, 1) (mulberry32). */
export function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}
