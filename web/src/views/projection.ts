/** Mapping between world points and pixels, for slices and for the turning view. */
import { pixelOf, rightOf } from '../core/camera';
import type { Camera, Pair, Plane, Vector, VolumeReport } from '../core/messages';
import { pixelOn, pointOn, voxelSide } from '../core/planes';
import { add, cross, dot, negate, scale, subtract } from '../core/vectors';

export interface Projection {
  readonly size: Pair;
  /** Size of a CSS pixel (mm). */
  readonly spacing: number;
  /** Whether the view shows all depths, not only a slice. */
  readonly isThrough: boolean;
  /** Direction of the rays of the view; null in a slice. */
  readonly along: Vector | null;
  pixel(point: Vector): Pair;
  /** Signed distance of a point from the view plane (mm). */
  depth(point: Vector): number;
  /** The point at a pixel that has the same depth as the point `like`. */
  at(pixel: Pair, like: Vector): Vector;
  /** World vector of a number of voxels to the right and downwards. */
  step(by: Pair): Vector;
}

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
