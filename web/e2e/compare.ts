/** Compares pictures per channel, with the tolerances of the GPU tests (`tolerances.rs` of lumencut-scenes). */

export interface Pixels {
  readonly width: number;
  readonly height: number;
  /** RGBA in rows from the top. */
  readonly bytes: Uint8Array;
}

/** Largest allowed difference of a channel (0 to 255), and the share of channels that may exceed it. */
export interface Tolerance {
  readonly apart: number;
  readonly share: number;
}

/** Tolerance for the same code: rounding may change a channel by 1. */
export const SAME_CODE: readonly Tolerance[] = [{ apart: 1, share: 0 }];

/** Tolerances for another device, as `COLOR` and `COLOR_LEAP` in `tolerances.rs`. */
export const OTHER_DEVICE: readonly Tolerance[] = [
  { apart: 1, share: 5e-4 },
  { apart: 4, share: 1e-4 },
];

/** Tolerances if one of two pictures is not supersampled, since the machine was busy. */
export const OTHER_SAMPLES: readonly Tolerance[] = [
  { apart: 1, share: 0.01 },
  { apart: 64, share: 0 },
];

export const OTHER_DEVICE_WITH_CONTEXT: readonly Tolerance[] = [{ apart: 4, share: 1e-3 }];

/** Description of a difference beyond the tolerances; null if there is none. */
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
