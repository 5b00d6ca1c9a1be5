/** Layout of the horizontal straightened vessel: its first point is on the left, as in plots of the Python package. */
import type { Pair, Picture } from '../core/messages';
import type { Axis } from './scale';

/** Smallest and largest width of the shown strip across the vessel (mm). */
const WIDTHS: Pair = [12, 90];
/** The strip shows at least this share of the width in which all sections fit. */
const MIN_FITTING_SHARE = 0.6;
const FINEST = 0.05;

export interface Lying {
  readonly width: number;
  /** Side of a pixel of the picture from the engine (mm). */
  readonly spacing: number;
  readonly height: number;
  /** Vertical magnification relative to the horizontal one; 1 is true to scale. */
  readonly stretch: number;
}

export interface Room {
  /** Available height (CSS pixels). */
  readonly height: number;
  /** Picture pixels per CSS pixel. */
  readonly density: number;
  /** Width in which all sections fit (mm). */
  readonly fitting: number;
}

export function lyingIn(x: Axis, { height: most, density, fitting }: Room): Lying {
  const side = (x.high - x.low) / (x.end - x.start);
  const wished = Math.max(MIN_FITTING_SHARE * fitting, Math.min(fitting, most * side));
  const width = Math.min(Math.max(wished, WIDTHS[0]), WIDTHS[1]);
  const height = Math.min(most, width / side);
  return {
    width,
    spacing: Math.max(side / density, FINEST),
    height,
    stretch: (height * side) / width,
  };
}

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

/** Position and size of the picture (CSS pixels); the centre of column `n` is at arc length `n` × spacing. */
export function lyingBox(x: Axis, { spacing, height, width }: Lying, [columns, rows]: Pair) {
  const perMm = (x.end - x.start) / (x.high - x.low);
  const pixel = spacing * perMm;
  const tall = (rows * spacing * height) / width;
  return { left: x.start - pixel / 2, top: (height - tall) / 2, width: columns * pixel, height: tall };
}
