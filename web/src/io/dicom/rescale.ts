/** Scales stored numbers to values of the volume. */
import { ARRAYS, type Kind, type Numbers } from '../numbers';

export interface Scaling {
  readonly slope: number;
  readonly intercept: number;
}

export function isScaled({ slope, intercept }: Scaling): boolean {
  return slope !== 1 || intercept !== 0;
}

/** Whether integers stay integers under slope and intercept. */
export function isIntegral({ slope, intercept }: Scaling): boolean {
  return Number.isInteger(slope) && Number.isInteger(intercept);
}

/** Scales numbers with 64-bit precision, and converts them to another type. */
export function scaled(numbers: Numbers, { slope, intercept }: Scaling, kind: Kind): Numbers {
  const result = new ARRAYS[kind as 'float64'](numbers.length);
  for (let i = 0; i < numbers.length; i += 1) {
    result[i] = Number(numbers[i]) * slope + intercept;
  }
  return result;
}
