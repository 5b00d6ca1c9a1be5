/** Layers and names of 3D Slicer segmentations; compressed files are inflated no further than needed. */
import { gzipSync } from 'node:zlib';
import { describe, expect, test } from 'vitest';
import { membersOf } from '../src/io/dicom/archive';
import { archived, file } from './made';
import { openSources } from './opened';

/** A segmentation of 4 × 3 × 2 voxels with these header lines and layers. */
function segmentation(lines: readonly string[], layers: readonly (readonly number[])[]): Buffer {
  const list = layers.length > 1;
  const header = [
    'NRRD0004',
    'type: unsigned char',
    `dimension: ${list ? 4 : 3}`,
    'space: left-posterior-superior',
    `sizes: ${list ? `${layers.length} ` : ''}4 3 2`,
    `space directions: ${list ? 'none ' : ''}(1,0,0) (0,1,0) (0,0,2)`,
    `kinds: ${list ? 'list ' : ''}domain domain domain`,
    'encoding: gzip',
    'space origin: (5,6,7)',
    ...lines,
  ];
  const voxels = (layers[0] ?? []).flatMap((_, voxel) => layers.map((layer) => layer[voxel] ?? 0));
  return Buffer.concat([Buffer.from(`${header.join('\n')}\n\n`), gzipSync(Uint8Array.from(voxels))]);
}

const segment = (n: number, name: string, layer: number, label: number) => [
  `Segment${n}_ID:=Segment_${n}`,
  `Segment${n}_Layer:=${layer}`,
  `Segment${n}_LabelValue:=${label}`,
  `Segment${n}_Name:=${name}`,
];
const first = Array.from({ length: 24 }, (_, i) => Number(i < 5));
const second = Array.from({ length: 24 }, (_, i) => Number(i > 20));

describe('a segmentation', () => {
  test('of one layer stays unchanged, with the names of its labels', async () => {
    const lines = [...segment(0, 'aorta', 0, 1), ...segment(1, 'vein', 0, 7)];
    const values = first.map((one, i) => one + 7 * (second[i] ?? 0));
    const { memory, failure } = await openSources([file('a.seg.nrrd', segmentation(lines, [values]))]);
    expect(failure).toBeNull();
    expect(memory.header?.label_names).toEqual({ 1: 'aorta', 7: 'vein' });
    expect([...memory.values]).toEqual(values);
  });

  test('in layers becomes one label map; segments that share a label are numbered from 1', async () => {
    const lines = [...segment(0, 'aorta', 0, 1), ...segment(1, 'vein', 1, 1)];
    const { memory, failure } = await openSources([file('a.seg.nrrd', segmentation(lines, [first, second]))]);
    expect(failure).toBeNull();
    expect(memory.header).toMatchObject({
      size: [4, 3, 2],
      dtype: 'uint8',
      label_names: { 1: 'aorta', 2: 'vein' },
    });
    expect(memory.header?.world_from_index[2]).toEqual([0, 0, 2, 7]);
    expect([...memory.values]).toEqual(first.map((one, i) => one + 2 * (second[i] ?? 0)));
  });

  test('from before 2020 has one segment in each layer', async () => {
    const lines = ['Segment0_ID:=a', 'Segment0_Name:=aorta', 'Segment1_ID:=b', 'Segment1_Name:=vein'];
    const { memory } = await openSources([file('a.seg.nrrd', segmentation(lines, [first, second]))]);
    expect([...memory.values]).toEqual(first.map((one, i) => one + 2 * (second[i] ?? 0)));
  });

  test('with overlapping or impossible segments is rejected, and the segments are named', async () => {
    const refused = async (lines: readonly string[], layers: readonly (readonly number[])[]) =>
      (await openSources([file('a.seg.nrrd', segmentation(lines, layers))])).failure?.found;
    const both = [...segment(0, 'aorta', 0, 1), ...segment(1, 'stent', 1, 1)];
    expect(await refused(both, [first, first])).toBe(
      'segments that overlap: 1 aorta and 2 stent in 5 voxels',
    );
    expect(await refused(segment(0, 'aorta', 3, 1), [first])).toBe('segment 1 aorta in layer 3 of 1');
    expect(await refused(segment(0, 'aorta', 0, 0), [first])).toBe('segment aorta with the label 0');
    expect(await refused([], [first, second])).toContain('several values per voxel');
  });
});

test('reading part of a member of an archive takes memory only for that part', async () => {
  const content = Buffer.from(Uint8Array.from({ length: 3_000_000 }, (_, i) => (i * 7) % 251));
  const [member] = await membersOf(file('a.zip', archived('IM0', content)));
  const part = await member?.slice(1_500_000, 1_500_010);
  expect(part?.buffer.byteLength).toBe(10);
  expect([...(part ?? [])]).toEqual([...content.subarray(1_500_000, 1_500_010)]);
  expect((await member?.slice(2_999_990, 4_000_000))?.length).toBe(10);
  expect((await member?.slice(4_000_000, 5_000_000))?.length).toBe(0);
});
