/** The types of voxels that the module computes with, and how wider ones become `float32`. */
import { Failure } from '../core/failure';

interface Narrowed {
  /** The type that the module gets. */
  readonly dtype: string;
  readonly bytesPerVoxel: number;
  /** Bytes of whole voxels as those of `dtype`. */
  readonly narrow: (bytes: Uint8Array) => Uint8Array;
}

const AS_THEY_ARE: Readonly<Record<string, number>> = { int8: 1, uint8: 1, int16: 2, uint16: 2, float32: 4 };

const WIDE = {
  int32: Int32Array,
  uint32: Uint32Array,
  float64: Float64Array,
} as const;

export function narrowed(dtype: string): Narrowed {
  const bytesPerVoxel = AS_THEY_ARE[dtype];
  if (bytesPerVoxel !== undefined) {
    return { dtype, bytesPerVoxel, narrow: (bytes) => bytes };
  }
  if (!(dtype in WIDE)) {
    const expected = [...Object.keys(AS_THEY_ARE), ...Object.keys(WIDE)].join(', ');
    throw new Failure('volume', 'type of the voxels', dtype, expected);
  }
  const Wide = WIDE[dtype as keyof typeof WIDE];
  const narrow = (bytes: Uint8Array) => {
    const voxels = new Wide(bytes.slice().buffer as ArrayBuffer);
    return new Uint8Array(Float32Array.from(voxels).buffer);
  };
  return { dtype: 'float32', bytesPerVoxel: Wide.BYTES_PER_ELEMENT, narrow };
}
