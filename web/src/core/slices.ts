/** Turns the planes of the slices about the cross-hair, and finds their lines in each other. */
import { areAxes, isNumber, isObject, isPositive } from './checks';
import type { Pair, Plane, SliceAxes, Slices, Vector } from './messages';
import { normalOf, type SliceName, STANDARD } from './planes';
import { dot, scale, subtract, turned, unit } from './vectors';

export const SLICE_NAMES: readonly SliceName[] = ['axial', 'coronal', 'sagittal'];

export const SLAB_MODES: readonly (readonly [string, string])[] = [
  ['max', 'MIP'],
  ['mean', 'mean'],
  ['min', 'minimum'],
];

/** Axes that differ by less are the same: turning there and back leaves rounding errors. */
const SAME = 1e-9;

export const areSame = (a: SliceAxes, b: SliceAxes): boolean =>
  dot(a.right, b.right) > 1 - SAME && dot(a.down, b.down) > 1 - SAME;

/** The planes after the other two were turned about the normal of one, from its right to down by an angle (radians). */
export function turnedSlices(slices: Slices, about: SliceName, angle: number): Slices {
  const axis = unit(normalOf(slices[about]));
  const turn = (name: SliceName): SliceAxes => {
    if (name === about) {
      return slices[name];
    }
    const right = unit(turned(slices[name].right, axis, angle));
    const loose = turned(slices[name].down, axis, angle);
    return { right, down: unit(subtract(loose, scale(right, dot(loose, right)))) };
  };
  return settled({ ...slices, axial: turn('axial'), coronal: turn('coronal'), sagittal: turn('sagittal') });
}

export const isTurned = (slices: Slices): boolean =>
  SLICE_NAMES.some((name) => slices[name] !== STANDARD[name]);

/** Slices in which planes that equal standard ones are these themselves, also after a file or another page held them. */
export function settled(slices: Slices): Slices {
  const known = (name: SliceName) => (areSame(slices[name], STANDARD[name]) ? STANDARD[name] : slices[name]);
  const found = {
    axial: known('axial'),
    coronal: known('coronal'),
    sagittal: known('sagittal'),
    slab: slices.slab,
  };
  return found.slab || isTurned(found) ? found : STANDARD;
}

/** Slices from an address; null if anything in them is invalid. */
export function slicesIn(value: unknown): Slices | null {
  if (!isObject(value)) {
    return null;
  }
  const { axial, coronal, sagittal, slab } = value as Record<string, { right: Vector; down: Vector }>;
  const planes = [axial, coronal, sagittal];
  const arePlanes = planes.every((plane) => isObject(plane) && areAxes(plane.right, plane.down));
  if (!arePlanes || !isSlab(slab)) {
    return null;
  }
  const [a, b, c] = planes.map((plane) => normalOf(plane as SliceAxes));
  return areAxes(a, b) && areAxes(b, c) && areAxes(c, a) ? settled(value as unknown as Slices) : null;
}

/** Largest thickness of a slab (mm). */
export const THICKEST = 1000;

const isSlab = (value: unknown): boolean =>
  value === null ||
  (Array.isArray(value) &&
    value.length === 2 &&
    isPositive(value[0]) &&
    isNumber(value[0]) &&
    value[0] <= THICKEST &&
    SLAB_MODES.some(([mode]) => mode === value[1]));

/** Unit vector in a slice (pixels) along the line in which another plane cuts it. */
export function lineOf(slices: Slices, here: SliceName, other: SliceName): Pair {
  const third = SLICE_NAMES.find((name) => name !== here && name !== other) ?? here;
  const normal = normalOf(slices[third]);
  return [dot(normal, slices[here].right), dot(normal, slices[here].down)];
}

/** The parts before and after `through` (pixels) of a line within a pane, at this distance from its edges; null outside. */
export function lineWithin(
  through: Pair,
  along: Pair,
  { size }: Pick<Plane, 'size'>,
  edge: number,
): Pair | null {
  let [from, to] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
  for (const axis of [0, 1] as const) {
    const ends = [edge, size[axis] - edge].map((side) => (side - through[axis]) / along[axis]);
    if (Math.abs(along[axis]) > SAME) {
      from = Math.max(from, Math.min(...ends));
      to = Math.min(to, Math.max(...ends));
    } else if (through[axis] < edge || through[axis] > size[axis] - edge) {
      return null;
    }
  }
  return from < to ? [from, to] : null;
}
