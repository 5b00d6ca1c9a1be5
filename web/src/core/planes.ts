/** Planes of the slices, and the mapping between their pixels and world coordinates. */
import { zoomedSpacing } from './camera';
import type { Pair, Plane, SliceAxes, Slices, Vector, VolumeReport } from './messages';
import { add, cross, dot, middle, scale, subtract } from './vectors';

export type SliceName = 'axial' | 'coronal' | 'sagittal';

/** The planes at first, in radiological convention: axial seen from the feet, coronal from the front, sagittal facing left. */
export const STANDARD: Slices = {
  axial: { right: [1, 0, 0], down: [0, 1, 0] },
  coronal: { right: [1, 0, 0], down: [0, 0, -1] },
  sagittal: { right: [0, 1, 0], down: [0, 0, -1] },
  slab: null,
};

/** Position of a slice view: its axes, its centre in the plane, and mm per pixel. */
export interface Look {
  readonly axes: SliceAxes;
  readonly center: Vector;
  readonly spacing: number;
}

export const normalOf = ({ right, down }: SliceAxes): Vector => cross(right, down);

export function fittedLook(volume: VolumeReport, axes: SliceAxes, size: Pair): Look {
  const center = middle(volume.corners);
  const { right, down } = axes;
  const reach = (axis: Vector) =>
    Math.max(...volume.corners.map((corner) => Math.abs(dot(subtract(corner, center), axis))));
  const spacing = Math.max((2 * reach(right)) / size[0], (2 * reach(down)) / size[1]);
  return { axes, center, spacing: spacing * 1.02 };
}

/** The position for another pane size; the shorter side keeps its extent in mm. */
export function resizedLook(look: Look, from: Pair, to: Pair): Look {
  return { ...look, spacing: (look.spacing * Math.min(...from)) / Math.min(...to) };
}

/** The position after its plane was turned to other axes about a point, which stays at its pixel. */
export function turnedLook(look: Look, axes: SliceAxes, pivot: Vector): Look {
  if (look.axes === axes) {
    return look;
  }
  const away = subtract(look.center, pivot);
  const [x, y] = [dot(away, look.axes.right), dot(away, look.axes.down)];
  return { ...look, axes, center: add(pivot, add(scale(axes.right, x), scale(axes.down, y))) };
}

export function planeOf(look: Look, through: Vector, size: Pair): Plane {
  const { right, down } = look.axes;
  const normal = normalOf(look.axes);
  const center = add(look.center, scale(normal, dot(subtract(through, look.center), normal)));
  return { center, right, down, size, pixel_spacing: look.spacing };
}

export function pointOn({ center, right, down, size, pixel_spacing }: Plane, [x, y]: Pair): Vector {
  const across = scale(right, (x - (size[0] - 1) / 2) * pixel_spacing);
  return add(add(center, across), scale(down, (y - (size[1] - 1) / 2) * pixel_spacing));
}

/** Column and row of a point, projected onto the plane along its normal. */
export function pixelOn({ center, right, down, size, pixel_spacing }: Plane, point: Vector): Pair {
  const offset = subtract(point, center);
  return [
    dot(offset, right) / pixel_spacing + (size[0] - 1) / 2,
    dot(offset, down) / pixel_spacing + (size[1] - 1) / 2,
  ];
}

export function pannedLook(look: Look, [x, y]: Pair): Look {
  const { right, down } = look.axes;
  const shift = add(scale(right, -x * look.spacing), scale(down, -y * look.spacing));
  return { ...look, center: add(look.center, shift) };
}

export function zoomedLook(look: Look, plane: Plane, factor: number, at: Pair): Look {
  const spacing = zoomedSpacing(look.spacing, factor);
  const kept = pointOn(plane, at);
  const toward = scale(subtract(plane.center, kept), spacing / look.spacing);
  return { ...look, center: add(kept, toward), spacing };
}

/** Distance between neighbouring voxels along a direction (mm). */
export function voxelSide(volume: VolumeReport, direction: Vector): number {
  const steps = [0, 1, 2].map((axis) => Math.abs(dot(column(volume, axis), direction)));
  return Math.max(...steps, 1e-3);
}

/** World vector to the next voxel along an index axis. */
function column(volume: VolumeReport, axis: number): Vector {
  return [0, 1, 2].map((row) => volume.world_from_index[row]?.[axis] ?? 0) as unknown as Vector;
}
