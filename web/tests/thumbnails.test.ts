/** Tests of the thumbnails of series. */
import { expect, test } from 'vitest';
import { series } from '../e2e/dicom';
import { pictureOf } from '../src/io/dicom/thumbnails';
import { file } from './made';
import { openSources } from './opened';

test('each of several series has a thumbnail of its middle slice; a single series is opened directly', async () => {
  const sources = (heights: readonly number[], uid: string) =>
    series(heights, 1, { uid, number: uid.slice(-1) }).map(({ name, buffer }) =>
      file(name, new Uint8Array(buffer)),
    );
  const first = sources([0, 2, 4, 6], '1.2.3');
  const { failure } = await openSources([...first, ...sources([0, 2, 4], '1.2.4')]);
  expect(failure?.series.map(({ uid }) => uid)).toEqual(['1.2.3', '1.2.4']);
  for (const { thumbnail } of failure?.series ?? []) {
    expect([thumbnail?.width, thumbnail?.height]).toEqual([64, 64]);
    // A bright rod of 4 mm in the middle of 16 × 16 mm.
    const at = (column: number, row: number) => thumbnail?.grey[row * 64 + column];
    expect([at(32, 32), at(2, 2), at(60, 32)]).toEqual([255, 0, 0]);
  }
  expect((await openSources(first)).failure).toBeNull();
});

test('a thumbnail has 64 pixels on its longer side, and its grey scale ignores extreme values', () => {
  const values = Float32Array.from({ length: 256 * 128 }, (_, n) => (n === 0 ? 1e6 : n % 256));
  const { width, height, grey } = pictureOf(values, [256, 128]);
  expect([width, height, grey.length]).toEqual([64, 32, 64 * 32]);
  expect([grey[0], grey.at(-1)]).toEqual([0, 255]);
  expect(grey[32]).toBeGreaterThan(120);
  expect(grey[32]).toBeLessThan(136);
  // The thumbnail of a constant slice is black; nothing is divided by zero.
  expect(new Set(pictureOf(new Int16Array(4).fill(7), [2, 2]).grey)).toEqual(new Set([0]));
});
