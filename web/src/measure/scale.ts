/** Linear axes: mapping between lengths and pixels. */
import type { Axis } from '../core/messages';

export function pixelAt({ low, high, start, end }: Axis, value: number): number {
  return start + ((value - low) / (high - low)) * (end - start);
}

/** The value at a pixel, clamped to the axis. */
export function valueAt({ low, high, start, end }: Axis, pixel: number): number {
  const value = low + ((pixel - start) / (end - start)) * (high - low);
  return Math.min(Math.max(value, low), high);
}
