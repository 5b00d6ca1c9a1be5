/** Turning, panning and zooming of a camera, as `drags.rs` does it. All functions return a new camera. */
import { GESTURES } from './generated/tables';
import type { Camera, Pair, Vector } from './messages';
import { add, cross, dot, scale, subtract, turned, unit } from './vectors';

export const rightOf = (camera: Camera): Vector => unit(cross(camera.direction, camera.up));

/** The camera turned about an axis through `pivot`, by an angle in radians. */
export function turnedAbout(camera: Camera, pivot: Vector, axis: Vector, angle: number): Camera {
  const around = unit(axis);
  const direction = unit(turned(camera.direction, around, angle));
  const loose = turned(camera.up, around, angle);
  const up = unit(subtract(loose, scale(direction, dot(loose, direction))));
  const center = add(pivot, turned(subtract(camera.center, pivot), around, angle));
  return { ...camera, center, direction, up };
}

/** Turns the scene like a trackball; a drag over the height of the view turns it by 180°. */
export function trackballed(camera: Camera, pivot: Vector, [x, y]: Pair): Camera {
  const axis = add(scale(camera.up, -x), scale(rightOf(camera), -y));
  return turnedAbout(camera, pivot, axis, angleOf(camera, Math.sqrt(x * x + y * y)));
}

/** Turns the scene about an axis by a drag to the right. */
export function spun(camera: Camera, pivot: Vector, axis: Vector, right: number): Camera {
  return turnedAbout(camera, pivot, axis, -angleOf(camera, right));
}

/** Rotation (radians) of a drag as long as some pixels. */
function angleOf({ size }: Pick<Camera, 'size'>, pixels: number): number {
  return pixels * (GESTURES.turn_per_height / Math.max(size[1], 1));
}

/** Moves the scene by a number of pixels to the right and downwards. */
export function panned(camera: Camera, [x, y]: Pair): Camera {
  const { pixel_spacing: side } = camera;
  const shift = add(scale(rightOf(camera), -x * side), scale(camera.up, y * side));
  return { ...camera, center: add(camera.center, shift) };
}

/** A pixel spacing (mm) after a zoom, within its limits. */
export function zoomedSpacing(spacing: number, factor: number): number {
  return Math.min(Math.max(spacing / factor, GESTURES.finest_spacing), GESTURES.coarsest_spacing);
}

/** The camera magnified by a factor; the point seen at `pixel` stays at that pixel. */
export function zoomed(camera: Camera, factor: number, pixel: Pair = middleOf(camera)): Camera {
  const spacing = zoomedSpacing(camera.pixel_spacing, factor);
  const middle = middleOf(camera);
  const away = camera.pixel_spacing - spacing;
  const shift = add(
    scale(rightOf(camera), (pixel[0] - middle[0]) * away),
    scale(camera.up, (middle[1] - pixel[1]) * away),
  );
  return { ...camera, pixel_spacing: spacing, center: add(camera.center, shift) };
}

/** The same view in another number of pixels; the shorter side keeps its extent in mm. */
export function resized(camera: Camera, size: Pair): Camera {
  const sides = (pixels: Pair) => Math.max(Math.min(pixels[0], pixels[1]), 1);
  return { ...camera, size, pixel_spacing: (camera.pixel_spacing * sides(camera.size)) / sides(size) };
}

/** The same view with more or fewer pixels, by a factor. */
export function sampled(camera: Camera, factor: number): Camera {
  const size = camera.size.map((count) => Math.max(Math.round(count * factor), 1)) as [number, number];
  return { ...camera, size, pixel_spacing: (camera.pixel_spacing * camera.size[1]) / size[1] };
}

/** Column and row of the centre of the image. */
export const middleOf = (camera: Camera): Pair => [(camera.size[0] - 1) / 2, (camera.size[1] - 1) / 2];

/** Column and row at which a world point is seen. */
export function pixelOf(camera: Camera, point: Vector): Pair {
  const away = subtract(point, camera.center);
  const [x, y] = middleOf(camera);
  return [
    x + dot(away, rightOf(camera)) / camera.pixel_spacing,
    y - dot(away, camera.up) / camera.pixel_spacing,
  ];
}
