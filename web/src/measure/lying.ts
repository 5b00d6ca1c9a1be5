/** The straightened vessel lying: its first point on the left, as Python's plots have it. */
import type { Pair, Picture } from '../core/messages';
import type { Axis } from './scale';

/** The narrowest and the widest strip (mm). */
const WIDTHS: Pair = [12, 90];
/** At least this share of what fits the vessel is seen across it. */
const LEAST = 0.6;
/** The finest pixel (mm). */
const FINEST = 0.05;

/** How a vessel of some length is laid into a strip. */
export interface Lying {
  /** What is seen across the vessel (mm). */
  readonly width: number;
  /** The side of a pixel of the engine's picture (mm). */
  readonly spacing: number;
  /** The height of the strip (CSS pixels). */
  readonly height: number;
  /** By how much it is drawn higher than it is long; 1 where it is true to scale. */
  readonly stretch: number;
}

/** The room that there is for a lying vessel. */
export interface Room {
  /** CSS pixels. */
  readonly height: number;
  /** Pixels of the engine in one of the page. */
  readonly density: number;
  /** The side of a picture that fits the vessel's sections (mm). */
  readonly fitting: number;
}

/** The vessel true to scale, where it has room so. */
export function lyingIn(x: Axis, { height: most, density, fitting }: Room): Lying {
  const side = (x.high - x.low) / (x.end - x.start);
  const wished = Math.max(LEAST * fitting, Math.min(fitting, most * side));
  const width = Math.min(Math.max(wished, WIDTHS[0]), WIDTHS[1]);
  const height = Math.min(most, width / side);
  return {
    width,
    spacing: Math.max(side / density, FINEST),
    height,
    stretch: (height * side) / width,
  };
}

/** Turned by 90 degrees to the left: rows become columns, the last column the first row. */
export function lyingPicture({ size: [width, height], bytes }: Picture): Picture {
  const from = new Uint32Array(bytes.buffer, bytes.byteOffset, width * height);
  const to = new Uint32Array(width * height);
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      to[(width - 1 - column) * height + row] = from[row * width + column] ?? 0;
    }
  }
  return { size: [height, width], bytes: new Uint8ClampedArray(to.buffer) };
}

/** Where the picture lies: the middle of its column `n` is at the arc length `n` times its spacing. */
export function lyingBox(x: Axis, { spacing, height, width }: Lying, [columns, rows]: Pair) {
  const perMm = (x.end - x.start) / (x.high - x.low);
  const pixel = spacing * perMm;
  const tall = (rows * spacing * height) / width;
  return { left: x.start - pixel / 2, top: (height - tall) / 2, width: columns * pixel, height: tall };
}
