/** Compares pictures channel by channel. The numbers are those of the tests of the GPU (`tolerances.rs` of lumencut-scenes). */

export interface Pixels {
  readonly width: number;
  readonly height: number;
  /** RGBA in rows from the top. */
  readonly bytes: Uint8Array;
}

/** How far apart channels may lie (steps of 255), and which share of all may lie further apart. */
export interface Tolerance {
  readonly apart: number;
  readonly share: number;
}

/** Two computations of the same code: rounding moves a channel by one step. */
export const SAME_CODE: readonly Tolerance[] = [{ apart: 1, share: 0 }];

/** Another device: `COLOR` and `COLOR_LEAP`. */
export const OTHER_DEVICE: readonly Tolerance[] = [
  { apart: 1, share: 5e-4 },
  { apart: 4, share: 1e-4 },
];

/** Another device, with a context around the vessels: `CONTEXT_OF_FRAME`. */
export const OTHER_DEVICE_WITH_CONTEXT: readonly Tolerance[] = [{ apart: 4, share: 1e-3 }];

/** What is wrong with a picture, in words; nothing where it is the same but for the tolerances. */
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

/** Whether a picture shows more than one colour. */
export function isEmpty({ bytes }: Pixels): boolean {
  return bytes.every((value, n) => value === bytes[n % 4]);
}
