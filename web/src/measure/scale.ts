/** The way between lengths and pixels, and where an axis has its ticks. */

/** A straight axis: `low` lies at the pixel `start`, `high` at `end`. */
export interface Axis {
  readonly low: number;
  readonly high: number;
  readonly start: number;
  readonly end: number;
}

export function pixelAt({ low, high, start, end }: Axis, value: number): number {
  return start + ((value - low) / (high - low)) * (end - start);
}

/** The value at a pixel; beyond the ends that of the end. */
export function valueAt({ low, high, start, end }: Axis, pixel: number): number {
  const value = low + ((pixel - start) / (end - start)) * (high - low);
  return Math.min(Math.max(value, low), high);
}

/** Steps of 1, 2 and 5 times a power of ten; at most `most` of them lie between both ends, which may be among them. */
export function ticks(low: number, high: number, most: number): number[] {
  const span = high - low;
  if (!(span > 0) || most < 1) {
    return [];
  }
  const power = 10 ** Math.floor(Math.log10(span / most));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => span / size <= most) ?? span;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  // Multiples, and no sum: so that no rounding adds up.
  return Array.from({ length: last - first + 1 }, (_, n) => Number(((first + n) * step).toPrecision(12)));
}
