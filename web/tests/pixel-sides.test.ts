/** The page saves a straightened vessel with pixels as large as those of Python. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import type { Pair, Vector } from '../src/core/messages';
import { Engine } from '../src/core/pkg/lumencut.js';
import { ask } from '../src/worker/answers';
import './traced';

interface Truth {
  readonly voxels: Vector;
  readonly line: readonly [Vector, Vector];
  readonly width: number;
  readonly cases: Readonly<Record<string, { spacing: Vector; side: number; size: Pair }>>;
}

const text = readFileSync(join(import.meta.dirname, '../../tests/pixel_sides.json'), 'utf-8');
const { voxels, line, width, cases } = JSON.parse(text) as Truth;
const count = voxels.reduce((product, side) => product * side, 1);

test.each(Object.entries(cases))('in %s voxels', async (_, { spacing, side, size }) => {
  const engine = await Engine.open('cpu');
  const [x, y, z] = spacing;
  const affine = [
    [x, 0, 0, 0],
    [0, y, 0, 0],
    [0, 0, z, 0],
    [0, 0, 0, 1],
  ];
  engine.begin_volume(JSON.stringify({ size: voxels, dtype: 'int16', world_from_index: affine }));
  engine.take_voxels(0, new Uint8Array(Int16Array.from({ length: count }, (_, n) => n % 1000).buffer));
  const rows = line.map((point) => point.map((index, axis) => index * (spacing[axis] ?? 1)).join());
  const bytes = new TextEncoder().encode(`x,y,z\n${rows.join('\n')}\n`);
  const wish = { coordinates: 'lps', unit: 'mm' };
  ask(engine, 'open_centerlines', { name: 'line.csv', wish }, { bytes });
  const spaced = ask(engine, 'report', null).volume?.pixel_side ?? 0;
  expect(spaced).toBeCloseTo(side, 12);
  const wide = width * Math.min(...spacing);
  const cpr = { vessel: 0, angle: 0, width: wide, pixel_spacing: spaced, feature: null, roll: null };
  expect(ask(engine, 'straightened', { cpr, window: [300, 700] }).size).toEqual(size);
});
