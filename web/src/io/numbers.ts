/** Types of stored numbers, and conversion of file bytes to typed arrays. */

export const ARRAYS = {
  int8: Int8Array,
  uint8: Uint8Array,
  int16: Int16Array,
  uint16: Uint16Array,
  int32: Int32Array,
  uint32: Uint32Array,
  int64: BigInt64Array,
  uint64: BigUint64Array,
  float32: Float32Array,
  float64: Float64Array,
} as const;

export type Kind = keyof typeof ARRAYS;

export type Numbers = InstanceType<(typeof ARRAYS)[Kind]>;

export interface StoredKind {
  readonly kind: Kind;
  readonly isBig: boolean;
}

const OF_THE_ENGINE: readonly Kind[] = ['uint8', 'int16', 'uint16', 'float32'];

/** The engine's type for a file's type: exact for small integers; float32 (24 significant bits) for wider numbers. */
export function inTheEngine(kind: Kind): Kind {
  return OF_THE_ENGINE.includes(kind) ? kind : kind === 'int8' ? 'int16' : 'float32';
}

export function byteCount(kind: Kind): number {
  return ARRAYS[kind].BYTES_PER_ELEMENT;
}

export function isInteger(kind: Kind): boolean {
  return !kind.startsWith('float');
}

/** Converts the whole numbers in the bytes, possibly in place. */
export function numbersOf({ kind, isBig }: StoredKind, bytes: Uint8Array<ArrayBuffer>): Numbers {
  const unit = byteCount(kind);
  const aligned = bytes.byteOffset % unit === 0 && !isBig ? bytes : bytes.slice();
  if (isBig && unit > 1) {
    swapBytes(aligned, unit);
  }
  const count = Math.floor(aligned.length / unit);
  return new ARRAYS[kind](aligned.buffer, aligned.byteOffset, count);
}

export function bytesOf(numbers: Numbers): Uint8Array<ArrayBuffer> {
  return new Uint8Array(numbers.buffer as ArrayBuffer, numbers.byteOffset, numbers.byteLength);
}

function swapBytes(bytes: Uint8Array, unit: number): void {
  for (let start = 0; start + unit <= bytes.length; start += unit) {
    bytes.subarray(start, start + unit).reverse();
  }
}

export function kindName(numbers: Numbers): Kind {
  const found = (Object.keys(ARRAYS) as Kind[]).find((kind) => numbers instanceof ARRAYS[kind]);
  return found ?? 'float64';
}

export function limits(kind: Kind): readonly [bigint, bigint] {
  const bits = BigInt(8 * byteCount(kind));
  return kind.startsWith('u') ? [0n, (1n << bits) - 1n] : [-(1n << (bits - 1n)), (1n << (bits - 1n)) - 1n];
}

const HOLDING: readonly Kind[] = ['int16', 'uint16', 'int32', 'uint32', 'int64'];

/** First integer type that holds `low` to `high`; null if none. */
export function holding(low: number, high: number, first?: Kind): Kind | null {
  const candidates = first === undefined ? HOLDING : [first, ...HOLDING];
  const holds = (kind: Kind) => {
    const [least, most] = limits(kind);
    return Number(least) <= low && high <= Number(most);
  };
  return candidates.find(holds) ?? null;
}
