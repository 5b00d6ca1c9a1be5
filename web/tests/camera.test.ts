import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import {
  middleOf,
  panned,
  pixelOf,
  resized,
  rightOf,
  sampled,
  spun,
  trackballed,
  turnedAbout,
  zoomed,
} from '../src/core/camera';
import type { Camera, Pair, Vector } from '../src/core/messages';
import { add, cross, dot, length, middle, scale, subtract, turned, unit } from '../src/core/vectors';
import { CAMERA, expectNear, expectOrthonormal, random } from './helpers';

function pointAt(camera: Camera, [x, y]: readonly [number, number]): Vector {
  const [mx, my] = middleOf(camera);
  const across = scale(rightOf(camera), (x - mx) * camera.pixel_spacing);
  return add(camera.center, add(across, scale(camera.up, (my - y) * camera.pixel_spacing)));
}

describe('vectors', () => {
  test('a quarter turn about z rotates x to y', () => {
    expectNear(turned([1, 0, 0], [0, 0, 1], Math.PI / 2), [0, 1, 0]);
    expectNear(turned([0, 0, 5], [0, 0, 1], 1.234), [0, 0, 5]);
  });

  test('a cross product is perpendicular to both vectors, and a zero vector stays zero', () => {
    const [a, b]: Vector[] = [
      [1, 2, 3],
      [-2, 0.5, 7],
    ];
    expect(dot(cross(a as Vector, b as Vector), a as Vector)).toBeCloseTo(0, 12);
    expect(length(unit([3, 4, 12]))).toBeCloseTo(1, 15);
    expect(unit([0, 0, 0])).toEqual([0, 0, 0]);
    expectNear(
      middle([
        [0, 0, 0],
        [2, 4, 6],
      ]),
      [1, 2, 3],
    );
  });
});

describe('turning', () => {
  test('a full circle is the identity', () => {
    const turnedOnce = turnedAbout(CAMERA, [50, 1, -7], [1, 2, -3], 2 * Math.PI);
    expectNear(turnedOnce.center, CAMERA.center);
    expectNear(turnedOnce.direction, CAMERA.direction);
    expectNear(turnedOnce.up, CAMERA.up);
  });

  test('a drag over twice the view height is a full turn', () => {
    const back = trackballed(CAMERA, [1, 2, 3], [0, 600]);
    expectNear(back.center, CAMERA.center);
    expectNear(back.up, CAMERA.up);
  });

  test('the pivot stays at its pixel', () => {
    const pivot: Vector = [17, 4, 21];
    const after = trackballed(CAMERA, pivot, [37, -81]);
    expectNear(pixelOf(after, pivot), pixelOf(CAMERA, pivot));
  });

  test('the front of the scene follows the drag', () => {
    const front: Vector = add(CAMERA.center, scale(CAMERA.direction, -40));
    const [x, y] = pixelOf(CAMERA, front);
    const [right] = pixelOf(trackballed(CAMERA, CAMERA.center, [10, 0]), front);
    const [, down] = pixelOf(trackballed(CAMERA, CAMERA.center, [0, 10]), front);
    expect(right).toBeGreaterThan(x);
    expect(down).toBeGreaterThan(y);
  });

  test('the axes stay orthonormal after 10,000 drags', () => {
    const next = random(7);
    let camera = CAMERA;
    for (let n = 0; n < 10_000; n++) {
      camera = trackballed(camera, [5, 5, 5], [40 * next() - 20, 40 * next() - 20]);
    }
    expectOrthonormal(camera.direction, camera.up);
    expect(length(subtract(camera.center, [5, 5, 5]))).toBeCloseTo(
      length(subtract(CAMERA.center, [5, 5, 5])),
      6,
    );
  });
});

test('axes that are not quite perpendicular become so', () => {
  const loose: Camera = { ...CAMERA, direction: [0.001, 1, 0], up: [0.01, 0.02, 1.003] };
  const { direction, up } = trackballed(loose, [0, 0, 0], [3, 4]);
  expectOrthonormal(direction, up);
});

describe('panning and zooming', () => {
  test('a pan moves by exactly its length in mm', () => {
    const after = panned(CAMERA, [10, -6]);
    // Seen from the front: the camera moves 10 pixels of 0.5 mm to the patient's right, and 6 down.
    expectNear(subtract(after.center, CAMERA.center), [-5, 0, -3]);
  });

  test('a zoom keeps the point under the pointer', () => {
    const turnedCamera = trackballed(CAMERA, CAMERA.center, [31, 47]);
    for (const factor of [0.3, 0.9, 1.7, 12]) {
      const kept = pointAt(turnedCamera, [371, 12]);
      const after = zoomed(turnedCamera, factor, [371, 12]);
      expectNear(pixelOf(after, kept), [371, 12]);
      expect(after.pixel_spacing).toBeCloseTo(0.5 / factor, 12);
    }
  });

  test('a zoom ends at its limits, and changes nothing there', () => {
    const finest = zoomed(CAMERA, 1e9, [3, 3]);
    expect(finest.pixel_spacing).toBe(0.005);
    expect(zoomed(finest, 2, [3, 3])).toEqual(finest);
    expect(zoomed(CAMERA, 1e-9).pixel_spacing).toBe(20);
  });
});

describe('the number of pixels', () => {
  test('the shorter side has the same extent after a resize', () => {
    const after = resized(CAMERA, [200, 700]);
    expect(200 * after.pixel_spacing).toBeCloseTo(300 * CAMERA.pixel_spacing, 12);
    expect(resized(after, [400, 300])).toEqual(CAMERA);
  });

  test('fewer pixels show the same part of the scene', () => {
    const after = sampled(CAMERA, 0.333);
    expect(after.size).toEqual([133, 100]);
    expect(after.size[1] * after.pixel_spacing).toBeCloseTo(150, 12);
    expect(sampled(CAMERA, 1e-6).size).toEqual([1, 1]);
  });
});

/** Drags with their ends, which the tests of Rust and Python read too. */
describe('drags end where they end in all hosts', () => {
  type Step =
    | ['rotate', Vector, Pair]
    | ['spin', Vector, Vector, number]
    | ['pan', Pair]
    | ['zoom', number, Pair];
  interface Cases {
    readonly drags: readonly { start: Camera; steps: Step[]; end: Camera }[];
    readonly samples: readonly { size: Pair; share: number; end: Pair; pixel_spacing: number }[];
  }
  const text = readFileSync(join(import.meta.dirname, '../../tests/drags.json'), 'utf-8');
  const { drags, samples } = JSON.parse(text) as Cases;

  function stepped(camera: Camera, step: Step): Camera {
    switch (step[0]) {
      case 'rotate':
        return trackballed(camera, step[1], step[2]);
      case 'spin':
        return spun(camera, step[1], step[2], step[3]);
      case 'pan':
        return panned(camera, step[1]);
      case 'zoom':
        return zoomed(camera, step[1], step[2]);
    }
  }

  const numbers = ({ center, direction, up, pixel_spacing }: Camera) => [
    ...center,
    ...direction,
    ...up,
    pixel_spacing,
  ];

  test.each(drags.map((drag, n) => [n, drag] as const))('drag %i', (_, { start, steps, end }) => {
    const found = steps.reduce(stepped, start);
    expect(found.size).toEqual(end.size);
    const expected = numbers(end);
    numbers(found).forEach((part, n) => {
      const wanted = expected[n] ?? Number.NaN;
      expect(Math.abs(part - wanted)).toBeLessThanOrEqual(1e-12 * Math.max(Math.abs(wanted), 1));
    });
  });

  test.each(samples)('$share of $size', ({ size, share, end, pixel_spacing }) => {
    const found = sampled({ ...CAMERA, size, pixel_spacing: 0.5 }, share);
    expect(found).toMatchObject({ size: end, pixel_spacing });
  });
});
