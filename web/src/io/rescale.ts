/** Scales stored numbers to values of the volume; integers stay integers if the engine has a type for them.
 */ import {
  ARRAYS,
  bytesOf,
  holding,
  inTheEngine,
  isInteger,
  type Kind,
  type Numbers,
  numbersOf,
  type StoredKind,
} from './numbers';

export interface Scaling {
  readonly slope: number;
  readonly intercept: number;
}

export const UNSCALED: Scaling = { slope: 1, intercept: 0 };

/** Conversion of bytes of a file to those of the engine. */
export interface Conversion {
  /** The type that the engine gets. */
  readonly kind: Kind;
  /** Bytes of whole voxels as those of `kind`. */
  readonly convert: (bytes: Uint8Array<ArrayBuffer>) => Uint8Array<ArrayBuffer>;
}

export function isScaled({ slope, intercept }: Scaling): boolean {
  return slope !== 1 || intercept !== 0;
}

/** Whether integers stay integers under slope and intercept. */
export function isIntegral({ slope, intercept }: Scaling): boolean {
  return Number.isInteger(slope) && Number.isInteger(intercept);
}

/** Whether the type of the result depends on the actual values. */
export function needsRange(stored: Kind, scaling: Scaling): boolean {
  return isScaled(scaling) && isInteger(stored) && isIntegral(scaling);
}

/** The type of scaled numbers in Python, given the smallest and the largest. */
export function scaledKind(stored: Kind, scaling: Scaling, range: readonly [number, number] | null): Kind {
  if (!isScaled(scaling)) {
    return stored;
  }
  if (range !== null && needsRange(stored, scaling)) {
    const ends = range.map((end) => end * scaling.slope + scaling.intercept);
    const kind = holding(Math.min(...ends), Math.max(...ends), stored);
    if (kind !== null) {
      return kind;
    }
  }
  return 'float32';
}

/** Scales numbers, each as a 64-bit float, to those of another type. */
export function scaled(numbers: Numbers, { slope, intercept }: Scaling, kind: Kind): Numbers {
  const result = new ARRAYS[kind as 'float64'](numbers.length);
  for (let i = 0; i < numbers.length; i += 1) {
    result[i] = Number(numbers[i]) * slope + intercept;
  }
  return result;
}

/** Converts a file's bytes to those of the engine; `range` is required if `needsRange` is true. */
export function conversion(
  stored: StoredKind,
  scaling: Scaling,
  range: readonly [number, number] | null,
): Conversion {
  const kind = inTheEngine(scaledKind(stored.kind, scaling, range));
  const isAsStored = !isScaled(scaling) && kind === stored.kind;
  const convert = (bytes: Uint8Array<ArrayBuffer>) => {
    if (isAsStored && !stored.isBig) {
      return bytes;
    }
    const numbers = numbersOf(stored, bytes);
    return bytesOf(isAsStored ? numbers : scaled(numbers, scaling, kind));
  };
  return { kind, convert };
}
