import { expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import { ARRAYS, EverySecond } from '../src/io/every-second';
import { random } from './helpers';
import { Memory } from './opened';

const AFFINE = [
  [0.4, 0.3, 0.1, -5],
  [-0.3, 0.5, 0, 7],
  [0, 0.1, 2, 11],
  [0, 0, 0, 1],
];

class Closable extends Memory {
  close(): void {}
}

const placed = (affine: readonly (readonly number[])[], index: readonly number[]) =>
  affine.slice(0, 3).map((row) => row.reduce((sum, value, a) => sum + value * (index[a] ?? 1), 0));

/** Streams voxels with the values 0, 1, 2 … in pieces of random length; returns the kept ones. */
function streamed(size: [number, number, number], dtype: keyof typeof ARRAYS, unit: number): Memory {
  const memory = new Closable();
  const sink = new EverySecond(memory);
  sink.begin_volume(JSON.stringify({ size, dtype, world_from_index: AFFINE, name: 'kept' }));
  const count = size[0] * size[1] * size[2];
  const values = Array.from({ length: count }, (_, n) => n % 251);
  const bytes = new Uint8Array(new ARRAYS[dtype](values).buffer);
  const next = random(count);
  for (let at = 0; at < count; ) {
    const end = Math.min(count, at + 1 + Math.floor(next() * 1.7 * size[0]));
    const piece = new Uint8Array(1 + (end - at) * unit).subarray(1);
    piece.set(bytes.subarray(at * unit, end * unit));
    sink.take_voxels(at * unit, piece);
    at = end;
  }
  return memory;
}

test.each([
  ['uint8', 1, [6, 4, 2]],
  ['int16', 2, [7, 5, 3]],
  ['uint16', 2, [1, 9, 4]],
  ['float32', 4, [8, 1, 5]],
] as const)('every second voxel of %s is kept, and lies where it did', (dtype, unit, [ni, nj, nk]) => {
  const { header, values } = streamed([ni, nj, nk], dtype, unit);
  const [mi, mj, mk] = [ni, nj, nk].map((n) => Math.ceil(n / 2)) as [number, number, number];
  expect(header?.size).toEqual([mi, mj, mk]);
  expect(values).toHaveLength(mi * mj * mk);
  values.forEach((value, n) => {
    const index = [n % mi, Math.floor(n / mi) % mj, Math.floor(n / (mi * mj))];
    const [i, j, k] = index.map((c) => 2 * c) as [number, number, number];
    expect(value).toBe(((k * nj + j) * ni + i) % 251);
    placed(header?.world_from_index ?? [], index).forEach((c, a) => {
      expect(c).toBeCloseTo(placed(AFFINE, [i, j, k])[a] ?? Number.NaN, 12);
    });
  });
});

test('a type that the engine does not support is rejected', () => {
  const sink = new EverySecond(new Closable());
  const header = { size: [2, 2, 2], dtype: 'complex64', world_from_index: AFFINE };
  expect(() => sink.begin_volume(JSON.stringify(header))).toThrow(Failure);
});
