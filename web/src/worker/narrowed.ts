/** Converts voxels to types that the engine supports. */
import { Failure } from '../core/failure';

interface Narrowed {
  readonly dtype: string;
  readonly bytesPerVoxel: number;
  /** Converts the bytes of complete voxels to the type `dtype`. */
  readonly narrow: (bytes: Uint8Array) => Uint8Array;
}

const AS_THEY_ARE: Readonly<Record<string, number>> = { uint8: 1, int16: 2, uint16: 2, float32: 4 };

/** Types that are converted: those of one byte exactly, wider ones to the 24 bits of a float32. */
const OTHERS = {
  int8: { From: Int8Array, To: Int16Array, dtype: 'int16' },
  int32: { From: Int32Array, To: Float32Array, dtype: 'float32' },
  uint32: { From: Uint32Array, To: Float32Array, dtype: 'float32' },
  float64: { From: Float64Array, To: Float32Array, dtype: 'float32' },
} as const;

export function narrowed(dtype: string): Narrowed {
  const bytesPerVoxel = Object.hasOwn(AS_THEY_ARE, dtype) ? AS_THEY_ARE[dtype] : undefined;
  if (bytesPerVoxel !== undefined) {
    return { dtype, bytesPerVoxel, narrow: (bytes) => bytes };
  }
  if (!Object.hasOwn(OTHERS, dtype)) {
    const expected = [...Object.keys(AS_THEY_ARE), ...Object.keys(OTHERS)].join(', ');
    throw new Failure('volume', 'type of the voxels', dtype, expected);
  }
  const { From, To, dtype: becomes } = OTHERS[dtype as keyof typeof OTHERS];
  const narrow = (bytes: Uint8Array) => {
    const voxels = new From(bytes.slice().buffer as ArrayBuffer);
    return new Uint8Array(To.from(voxels).buffer);
  };
  return { dtype: becomes, bytesPerVoxel: From.BYTES_PER_ELEMENT, narrow };
}
