/** Picture of the straightened vessel, turned so that its first point is on the left. */
import type { Axis, Pair, Picture, StripLayout } from '../core/messages';

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

/** Box of the picture: the centre of column `n` is at arc length `n` × spacing. */
export function lyingBox(x: Axis, { spacing, height, width }: StripLayout, [columns, rows]: Pair) {
  const perMm = (x.end - x.start) / (x.high - x.low);
  const pixel = spacing * perMm;
  const tall = (rows * spacing * height) / width;
  return { left: x.start - pixel / 2, top: (height - tall) / 2, width: columns * pixel, height: tall };
}
