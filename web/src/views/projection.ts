/** Where points of the world are seen in a view, and the way back: the same questions to slices and to the turning view. */
import { pixelOf, rightOf } from '../core/camera';
import type { Camera, Pair, Plane, Vector, VolumeReport } from '../core/messages';
import { pixelOn, pointOn, voxelSide } from '../core/planes';
import { add, cross, dot, negate, scale, subtract } from '../core/vectors';

export interface Projection {
  /** CSS pixels. */
  readonly size: Pair;
  /** mm per CSS pixel. */
  readonly spacing: number;
  /** Whether all depths are seen at once. */
  readonly isThrough: boolean;
  /** The direction of the rays through which all depths are seen; null in a slice. */
  readonly along: Vector | null;
  pixel(point: Vector): Pair;
  /** How far a point is before or behind the plane of the view (mm, with its sign). */
  depth(point: Vector): number;
  /** The point at a pixel that is as deep as another point. */
  at(pixel: Pair, like: Vector): Vector;
  /** The way of a number of voxels to the right and downwards. */
  step(by: Pair): Vector;
}

/** A slice: points lie on it, before it or behind it. */
export function ofPlane(plane: Plane, volume: VolumeReport): Projection {
  const normal = cross(plane.right, plane.down);
  const depth = (point: Vector) => dot(subtract(point, plane.center), normal);
  return {
    size: plane.size,
    spacing: plane.pixel_spacing,
    isThrough: false,
    along: null,
    pixel: (point) => pixelOn(plane, point),
    depth,
    at: (pixel, like) => add(pointOn(plane, pixel), scale(normal, depth(like))),
    step: (by) => stepOf(volume, plane.right, plane.down, by),
  };
}

/** The turning view, through which points of all depths are seen. */
export function ofCamera(camera: Camera, volume: VolumeReport): Projection {
  const [right, down] = [rightOf(camera), negate(camera.up)];
  const onPlane = (pixel: Pair): Vector => {
    const [x, y] = pixelOf(camera, camera.center);
    const across = scale(right, (pixel[0] - x) * camera.pixel_spacing);
    return add(add(camera.center, across), scale(down, (pixel[1] - y) * camera.pixel_spacing));
  };
  const depth = (point: Vector) => dot(subtract(point, camera.center), camera.direction);
  return {
    size: camera.size,
    spacing: camera.pixel_spacing,
    isThrough: true,
    along: camera.direction,
    pixel: (point) => pixelOf(camera, point),
    depth,
    at: (pixel, like) => add(onPlane(pixel), scale(camera.direction, depth(like))),
    step: (by) => stepOf(volume, right, down, by),
  };
}

function stepOf(volume: VolumeReport, right: Vector, down: Vector, [x, y]: Pair): Vector {
  return add(scale(right, x * voxelSide(volume, right)), scale(down, y * voxelSide(volume, down)));
}
