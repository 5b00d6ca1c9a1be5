/** The page takes size, grid and names of a 3D Slicer segmentation from the reader (`crates/lumencut-volumes`). */
import { expect, test } from 'vitest';
import { file } from './made';
import { openSources } from './opened';

const FIRST = Array.from({ length: 24 }, (_, i) => Number(i < 5));
const SECOND = Array.from({ length: 24 }, (_, i) => Number(i > 20));

/** A segmentation of 4 × 3 × 2 voxels in two layers, whose segments have the same label. */
function segmentation(): Buffer {
  const header = [
    'NRRD0004',
    'type: unsigned char',
    'dimension: 4',
    'space: left-posterior-superior',
    'sizes: 2 4 3 2',
    'space directions: none (1,0,0) (0,1,0) (0,0,2)',
    'kinds: list domain domain domain',
    'encoding: raw',
    'space origin: (5,6,7)',
    ...['aorta', 'vein'].flatMap((name, n) => [
      `Segment${n}_Layer:=${n}`,
      `Segment${n}_LabelValue:=1`,
      `Segment${n}_Name:=${name}`,
    ]),
  ];
  const voxels = FIRST.flatMap((value, i) => [value, SECOND[i] ?? 0]);
  return Buffer.concat([Buffer.from(`${header.join('\n')}\n\n`), Uint8Array.from(voxels)]);
}

test('a segmentation in layers becomes one label map with names', async () => {
  const { memory, failure } = await openSources([file('a.seg.nrrd', segmentation())]);
  expect(failure).toBeNull();
  expect(memory.header).toMatchObject({
    size: [4, 3, 2],
    dtype: 'uint8',
    label_names: { 1: 'aorta', 2: 'vein' },
  });
  expect(memory.header?.world_from_index[2]).toEqual([0, 0, 2, 7]);
  expect([...memory.values]).toEqual(FIRST.map((one, i) => one + 2 * (SECOND[i] ?? 0)));
});
