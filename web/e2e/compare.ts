/** Compares pictures per channel, with the tolerances of the GPU tests (`tolerances.rs` of lumencut-scenes). */

export interface Pixels {
  readonly width: number;
  readonly height: number;
  /** RGBA in rows from the top. */
  readonly bytes: Uint8Array;
}

/** Allowed difference of channels (steps of 255), and the share that may exceed it. */
export interface Tolerance {
  readonly apart: number;
  readonly share: number;
}

/** Same code: rounding moves a channel by one step. */
export const SAME_CODE: readonly Tolerance[] = [{ apart: 1, share: 0 }];

/** Another device: `COLOR` and `COLOR_LEAP`. */
export const OTHER_DEVICE: readonly Tolerance[] = [
  { apart: 1, share: 5e-4 },
  { apart: 4, share: 1e-4 },
];

export const OTHER_DEVICE_WITH_CONTEXT: readonly Tolerance[] = [{ apart: 4, share: 1e-3 }];

/** Description of the difference; null within the tolerances. */
export function difference(found: Pixels, expected: Pixels, tolerances: readonly Tolerance[]): string | null {
  if (found.width !== expected.width || found.height !== expected.height) {
    return `found ${found.width} × ${found.height} pixels; expected ${expected.width} × ${expected.height}`;
  }
  const apart = expected.bytes.map((value, n) => Math.abs(value - (found.bytes[n] ?? 256)));
  const most = apart.reduce((a, b) => Math.max(a, b), 0);
  const wrong = tolerances
    .map((tolerance) => ({ ...tolerance, further: apart.filter((step) => step > tolerance.apart).length }))
    .find(({ further, share }) => further > share * apart.length);
  return wrong
    ? `${wrong.further} of ${apart.length} channels are further apart than ${wrong.apart}, at most ${most}`
    : null;
}

export function isEmpty({ bytes }: Pixels): boolean {
  return bytes.every((value, n) => value === bytes[n % 4]);
}
