/** Linear axes: convert lengths to pixels and back, and choose ticks. */

/** The value `low` lies at pixel `start`, the value `high` at pixel `end`. */
export interface Axis {
  readonly low: number;
  readonly high: number;
  readonly start: number;
  readonly end: number;
}

export function pixelAt({ low, high, start, end }: Axis, value: number): number {
  return start + ((value - low) / (high - low)) * (end - start);
}

/** The value at a pixel, clamped to the axis. */
export function valueAt({ low, high, start, end }: Axis, pixel: number): number {
  const value = low + ((pixel - start) / (end - start)) * (high - low);
  return Math.min(Math.max(value, low), high);
}

/** At most `most` ticks, in steps of 1, 2 or 5 times a power of ten. */
export function ticks(low: number, high: number, most: number): number[] {
  const span = high - low;
  if (!(span > 0) || most < 1) {
    return [];
  }
  const power = 10 ** Math.floor(Math.log10(span / most));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => span / size <= most) ?? span;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  // Computed as multiples of the step, so that rounding errors do not add up.
  return Array.from({ length: last - first + 1 }, (_, n) => Number(((first + n) * step).toPrecision(12)));
}
