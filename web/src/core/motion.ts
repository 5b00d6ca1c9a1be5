/** Rigid motions from the coordinates of one scan to those of another. */
import type { Camera, Motion, SliceAxes, Slices, Vector } from './messages';
import { settled } from './slices';
import { add, dot, negate } from './vectors';

export const turnedBy = ({ rotation: [x, y, z] }: Motion, vector: Vector): Vector => [
  dot(x, vector),
  dot(y, vector),
  dot(z, vector),
];

export const movedBy = (motion: Motion, point: Vector): Vector => add(turnedBy(motion, point), motion.shift);

export function inverseOf({ rotation: [x, y, z], shift }: Motion): Motion {
  const rotation = [
    [x[0], y[0], z[0]],
    [x[1], y[1], z[1]],
    [x[2], y[2], z[2]],
  ] as const;
  return { rotation, shift: negate(turnedBy({ rotation, shift }, shift)) };
}

/** The camera that sees in the other scan what `camera` sees in this one. */
export const cameraBy = (motion: Motion, camera: Camera): Camera => ({
  ...camera,
  center: movedBy(motion, camera.center),
  direction: turnedBy(motion, camera.direction),
  up: turnedBy(motion, camera.up),
});

export function slicesBy(motion: Motion, { axial, coronal, sagittal, slab }: Slices): Slices {
  const turn = ({ right, down }: SliceAxes): SliceAxes => ({
    right: turnedBy(motion, right),
    down: turnedBy(motion, down),
  });
  return settled({ axial: turn(axial), coronal: turn(coronal), sagittal: turn(sagittal), slab });
}
