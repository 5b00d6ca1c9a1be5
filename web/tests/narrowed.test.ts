import { describe, expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import { narrowed } from '../src/worker/fetching';

const bytesOf = (numbers: { buffer: ArrayBufferLike }) => new Uint8Array(numbers.buffer as ArrayBuffer);

test.each([
  ['uint8', 1],
  ['int16', 2],
  ['uint16', 2],
  ['float32', 4],
])('%s stays as it is', (dtype, side) => {
  const { dtype: becomes, bytesPerVoxel, narrow } = narrowed(dtype);
  const bytes = Uint8Array.of(1, 2, 3, 255);
  expect([becomes, bytesPerVoxel, narrow(bytes)]).toEqual([dtype, side, bytes]);
});

test('signed bytes become int16 exactly', () => {
  const { dtype, bytesPerVoxel, narrow } = narrowed('int8');
  const all = Int8Array.from({ length: 256 }, (_, n) => n - 128);
  expect([dtype, bytesPerVoxel]).toEqual(['int16', 1]);
  expect([...new Int16Array(narrow(bytesOf(all)).buffer as ArrayBuffer)]).toEqual([...all]);
});

describe.each([
  ['int32', Int32Array.of(-1024, 0, 3071, -(2 ** 24), 2 ** 31 - 1)],
  ['uint32', Uint32Array.of(0, 1, 65_535, 2 ** 24, 2 ** 32 - 1)],
  ['float64', Float64Array.of(-0.1, 1e-3, 3071.25, Number.NaN, 1e300)],
] as const)('%s', (name, numbers) => {
  test('becomes float32, rounded to the nearest value', () => {
    const { dtype, bytesPerVoxel, narrow } = narrowed(name);
    expect([dtype, bytesPerVoxel]).toEqual(['float32', numbers.BYTES_PER_ELEMENT]);
    const found = new Float32Array(narrow(bytesOf(numbers)).buffer as ArrayBuffer);
    expect([...found]).toEqual([...numbers].map(Math.fround));
  });

  test('is converted at any offset in a larger piece', () => {
    const raw = bytesOf(numbers);
    const odd = new Uint8Array(raw.length + 3);
    odd.set(raw, 3);
    const { narrow } = narrowed(name);
    expect(narrow(odd.subarray(3))).toEqual(narrow(raw));
  });
});

test.each(['complex64', 'RGB', '', 'toString', '__proto__'])('the type "%s" is refused in words', (dtype) => {
  const refused = () => narrowed(dtype);
  expect(refused).toThrow(Failure);
  expect(refused).toThrow(/type of the voxels: found .*expected uint8, int16, uint16, float32, int8/);
});
