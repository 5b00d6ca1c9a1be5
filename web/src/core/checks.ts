/** Checks values that others wrote, such as an address. */
import type { Vector } from './messages';
import { dot, length } from './vectors';

/** Largest accepted position (mm) or value; beyond it, rounding errors would matter. */
export const LARGEST = 1e6;
/** Tolerance when checking that axes are orthonormal. */
const ROUNDING = 1e-3;

export const isNumber = (value: unknown): value is number =>
  typeof value === 'number' && Math.abs(value) <= LARGEST;
export const isPositive = (value: unknown): value is number => isNumber(value) && value > 0;
export const isVector = (value: unknown): value is Vector =>
  Array.isArray(value) && value.length === 3 && value.every(isNumber);
export const isObject = (value: unknown): value is Record<string, unknown> =>
  value !== null && typeof value === 'object' && !Array.isArray(value);

export function areAxes(a: unknown, b: unknown): boolean {
  const isZero = (number: number) => Math.abs(number) < ROUNDING;
  return isVector(a) && isVector(b) && isZero(length(a) - 1) && isZero(length(b) - 1) && isZero(dot(a, b));
}
