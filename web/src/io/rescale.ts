/** Stored numbers become values of the volume: integers stay integers wherever the engine has a type for them. */
import {
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

/** How the bytes of a file become those of the engine. */
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

/** Whether the type of the result depends on the values that there are. */
export function needsRange(stored: Kind, scaling: Scaling): boolean {
  return isScaled(scaling) && isInteger(stored) && isIntegral(scaling);
}

/** The type that scaled numbers have in Python, where the smallest and the largest are known. */
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

/** How a file's bytes become those of the engine; `range` is asked for where `needsRange` says so. */
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
