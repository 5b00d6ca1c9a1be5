/** Planes that are turned about the cross-hair stay perpendicular, and show the lines of each other. */
import { afterEach, describe, expect, test } from 'vitest';
import type { Slices, Vector } from '../src/core/messages';
import { normalOf, pixelOn, planeOf, STANDARD, turnedLook } from '../src/core/planes';
import { isTurned, lineOf, lineWithin, SLICE_NAMES, slicesIn, turnedSlices } from '../src/core/slices';
import { add, cross, dot, scale } from '../src/core/vectors';
import { begin, document_, redo, undo, undoWords } from '../src/state/history';
import {
  beginTurn,
  chooseSlab,
  endTurn,
  putTurnBack,
  straighten,
  turnBySteps,
  turnPlanes,
} from '../src/state/slices';
import { slices } from '../src/state/store';
import { expectNear } from './helpers';

const HAIR: Vector = [12, -7, 30];
const SIZE = [301, 201] as const;
const OBLIQUE = turnedSlices(
  turnedSlices(turnedSlices(STANDARD, 'axial', 0.4), 'coronal', -1.1),
  'sagittal',
  2.2,
);

afterEach(() => {
  slices.value = STANDARD;
  begin(document_.value);
});

const planeIn = (all: Slices, name: 'axial' | 'coronal' | 'sagittal') => {
  const look = { axes: STANDARD[name], center: [40, 10, -3] as Vector, spacing: 0.7 };
  return planeOf(turnedLook(look, all[name], HAIR), HAIR, SIZE);
};

describe('planes', () => {
  test('stay perpendicular, keep their handedness, and the slice of the drag stays as it is', () => {
    for (const name of SLICE_NAMES) {
      const { right, down } = OBLIQUE[name];
      expectNear([dot(right, right), dot(down, down), dot(right, down)], [1, 1, 0]);
    }
    const [a, b, c] = SLICE_NAMES.map((name) => normalOf(OBLIQUE[name])) as [Vector, Vector, Vector];
    const [p, q, r] = SLICE_NAMES.map((name) => normalOf(STANDARD[name])) as [Vector, Vector, Vector];
    expect(dot(cross(a, b), c)).toBeCloseTo(dot(cross(p, q), r), 9);
    expect(turnedSlices(OBLIQUE, 'coronal', 1).coronal).toBe(OBLIQUE.coronal);
  });

  test('a turn by 30° in the axial slice turns the others about the axis of the body', () => {
    const turned = turnedSlices(STANDARD, 'axial', Math.PI / 6);
    const [cos, sin] = [Math.cos(Math.PI / 6), Math.sin(Math.PI / 6)];
    expectNear(turned.coronal.right, [cos, sin, 0]);
    expectNear(turned.coronal.down, [0, 0, -1]);
    expectNear(turned.sagittal.right, [-sin, cos, 0]);
  });

  test('a turn there and back gives the standard planes, without rounding errors', () => {
    const there = turnedSlices(STANDARD, 'sagittal', 0.3);
    expect(isTurned(there)).toBe(true);
    expect(turnedSlices(there, 'sagittal', -0.3)).toBe(STANDARD);
  });

  test('the cross-hair keeps its pixel while its plane turns, and later moves do not move the picture', () => {
    for (const name of SLICE_NAMES) {
      expectNear(pixelOn(planeIn(OBLIQUE, name), HAIR), pixelOn(planeIn(STANDARD, name), HAIR));
    }
  });
});

test.each([STANDARD, OBLIQUE])('the line of a plane in a slice lies in both', (all) => {
  for (const here of SLICE_NAMES) {
    const plane = planeIn(all, here);
    for (const other of SLICE_NAMES.filter((name) => name !== here)) {
      const [x, y] = lineOf(all, here, other);
      expect(Math.hypot(x, y)).toBeCloseTo(1, 9);
      const along = add(scale(plane.right, x), scale(plane.down, y));
      expect(dot(along, normalOf(all[other]))).toBeCloseTo(0, 9);
      const ends = lineWithin(pixelOn(plane, HAIR), [x, y], plane, 26);
      for (const end of ends ?? []) {
        const [column, row] = pixelOn(plane, add(HAIR, scale(along, end * plane.pixel_spacing)));
        const edges = [column - 26, SIZE[0] - 26 - column, row - 26, SIZE[1] - 26 - row];
        expect(Math.min(...edges)).toBeCloseTo(0, 6);
      }
    }
  }
});

test('a line beside the pane is not shown', () => {
  const plane = planeIn(STANDARD, 'axial');
  expect(lineWithin([-5, 100], [0, 1], plane, 26)).toBeNull();
  expect(lineWithin([-50, -300], [Math.SQRT1_2, Math.SQRT1_2], plane, 26)).toBeNull();
  expect(lineWithin([-5, 100], [1, 0], plane, 26)).toEqual([31, 280]);
});

test('an address holds planes only if they are perpendicular, and a slab only if it can be', () => {
  const held = (value: unknown) => slicesIn(JSON.parse(JSON.stringify(value)));
  expect(held({ ...OBLIQUE, slab: [10, 'mean'] })).toEqual({ ...OBLIQUE, slab: [10, 'mean'] });
  for (const slab of [[0, 'max'], [-3, 'max'], [1e5, 'max'], [5, 'median'], [5], 'max', 5, undefined]) {
    expect(held({ ...OBLIQUE, slab })).toBeNull();
  }
  const slab = held({ ...STANDARD, slab: [10, 'mean'] });
  expect(slab && isTurned(slab)).toBe(false);
  const { axial, coronal } = OBLIQUE;
  const longer = { ...axial, right: scale(axial.right, 1.1) };
  for (const wrong of [null, [], 5, {}, { ...OBLIQUE, axial: coronal }, { ...OBLIQUE, axial: longer }]) {
    expect(held(wrong)).toBeNull();
  }
});

describe('undo', () => {
  test('a drag is one step, and Escape leaves none', () => {
    beginTurn();
    turnPlanes('axial', 0.1);
    turnPlanes('axial', 0.3);
    const shown = slices.value;
    endTurn();
    expect(shown).toEqual(turnedSlices(STANDARD, 'axial', 0.3));
    expect(undoWords.value).toBe('turn the planes');
    undo();
    expect(slices.value).toBe(STANDARD);
    redo();
    expect(slices.value).toBe(shown);
    beginTurn();
    turnPlanes('coronal', 0.3);
    putTurnBack();
    endTurn();
    expect(slices.value).toBe(shown);
    undo();
    expect(undoWords.value).toBeNull();
  });

  test('keys, slab and the standard planes are steps as well', () => {
    turnBySteps('coronal', 2);
    expect(slices.value).toEqual(turnedSlices(STANDARD, 'coronal', Math.PI / 18));
    chooseSlab([10, 'max']);
    straighten();
    expect(slices.value).toEqual({ ...STANDARD, slab: [10, 'max'] });
    expect(undoWords.value).toBe('reset the planes');
    chooseSlab(null);
    expect(slices.value).toBe(STANDARD);
    for (const words of ['change the slab', 'reset the planes', 'change the slab', 'turn the planes']) {
      expect(undoWords.value).toBe(words);
      undo();
    }
    expect(slices.value).toBe(STANDARD);
  });
});
