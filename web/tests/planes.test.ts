import { describe, expect, test } from 'vitest';
import type { Vector, VolumeReport } from '../src/core/messages';
import {
  fittedLook,
  normalOf,
  pannedLook,
  pixelOn,
  planeOf,
  pointOn,
  resizedLook,
  type SliceName,
  STANDARD,
  voxelSide,
  zoomedLook,
} from '../src/core/planes';
import { expectNear } from './helpers';

const NAMES: readonly SliceName[] = ['axial', 'coronal', 'sagittal'];

/** A volume of 100 × 60 × 40 mm with voxels of 1 × 2 × 4 mm. */
const VOLUME: VolumeReport = {
  size: [100, 30, 10],
  world_from_index: [
    [1, 0, 0, -50],
    [0, 2, 0, -30],
    [0, 0, 4, -20],
    [0, 0, 0, 1],
  ],
  corners: [-50, 50].flatMap((x) =>
    [-30, 30].flatMap((y) => [-20, 20].map((z) => [x, y, z] as unknown as Vector)),
  ),
  smallest_side: 1,
  pixel_side: 0.25,
  scan: '',
  doubt: null,
  notes: [],
};
const THROUGH: Vector = [3, -11, 7];

describe.each(NAMES)('%s', (name) => {
  const size = [320, 240] as const;
  const look = fittedLook(VOLUME, STANDARD[name], size);
  const plane = planeOf(look, THROUGH, size);

  test('a pixel converts to the world and back', () => {
    for (const at of [
      [0, 0],
      [319, 239],
      [17.25, 101.5],
    ] as const) {
      expectNear(pixelOn(plane, pointOn(plane, at)), at);
    }
  });

  test('the plane contains the point that it goes through', () => {
    expectNear(pointOn(plane, pixelOn(plane, THROUGH)), THROUGH);
  });

  test('the whole volume fits', () => {
    for (const corner of VOLUME.corners) {
      const [x, y] = pixelOn(plane, corner);
      expect(x).toBeGreaterThan(-0.5);
      expect(x).toBeLessThan(319.5);
      expect(y).toBeGreaterThan(-0.5);
      expect(y).toBeLessThan(239.5);
    }
  });

  test('a zoom keeps the point under the pointer, and a pan moves with the pointer', () => {
    const kept = pointOn(plane, [40, 200]);
    const closer = planeOf(zoomedLook(look, plane, 2.5, [40, 200]), THROUGH, size);
    expectNear(pixelOn(closer, kept), [40, 200]);
    const moved = planeOf(pannedLook(look, [12, -5]), THROUGH, size);
    const [x, y] = pixelOn(plane, kept);
    expectNear(pixelOn(moved, kept), [x + 12, y - 5]);
  });
});

test('in a pane of another size, the shorter side shows the same extent', () => {
  const look = { axes: STANDARD.axial, center: THROUGH, spacing: 0.5 };
  expect(resizedLook(look, [300, 200], [800, 400])).toEqual({ ...look, spacing: 0.25 });
  expect(resizedLook(resizedLook(look, [300, 200], [7, 9]), [7, 9], [300, 200])).toEqual(look);
});

describe('orientation', () => {
  const seen = (name: SliceName, direction: Vector) => {
    const plane = planeOf({ axes: STANDARD[name], center: [0, 0, 0], spacing: 1 }, [0, 0, 0], [101, 101]);
    const [x, y] = pixelOn(plane, direction);
    return [x - 50, y - 50];
  };
  const [left, posterior, superior]: Vector[] = [
    [10, 0, 0],
    [0, 10, 0],
    [0, 0, 10],
  ];

  test("axial: the patient's left is on the right, the front on top", () => {
    expectNear(seen('axial', left as Vector), [10, 0]);
    expectNear(seen('axial', posterior as Vector), [0, 10]);
  });

  test("coronal: the patient's left is on the right, the head on top", () => {
    expectNear(seen('coronal', left as Vector), [10, 0]);
    expectNear(seen('coronal', superior as Vector), [0, -10]);
  });

  test('sagittal: the back is on the right, the head on top', () => {
    expectNear(seen('sagittal', posterior as Vector), [10, 0]);
    expectNear(seen('sagittal', superior as Vector), [0, -10]);
  });

  test('slices are as far apart as voxels along the normal', () => {
    expect(NAMES.map((name) => voxelSide(VOLUME, normalOf(STANDARD[name])))).toEqual([4, 2, 1]);
  });
});
