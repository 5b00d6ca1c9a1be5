/** A scan as a file that the page and the command line read: two tubes that do not meet, one of them narrowed, and bone behind them. */
import { expect } from '@playwright/test';
import type { Pair } from '../src/core/messages';
import { expectBegun, fileOf, type MadeFile, traced } from './controls';
import type { PaneName, Viewer } from './page';

/** Voxels along each axis, and their side (mm); the middle of the volume is at 0. */
const COUNTS = [80, 56, 90] as const;
const SIDE = 0.8;
const HALF = COUNTS.map((count) => ((count - 1) * SIDE) / 2) as [number, number, number];

/** Where the axes of the tubes are (mm to the patient's left), and where that of a bone is (mm backwards, in the middle). */
export const NARROWED = -12;
export const STRAIGHT = 12;
export const BONE = 15;

const radius = (z: number): number => 4 - 2 * Math.exp(-((z / 6) ** 2));

/** 350 HU within, -100 without, and between them what a scanner makes of an edge. */
const lumen = (inside: number): number => -100 + 450 * Math.min(Math.max(0.5 + inside / 1.6, 0), 1);

/** `shift` moves all of it along the patient (mm): the grid of another scan. */
export function tubes(name: string, shift = 0): MadeFile {
  const [columns, rows, slices] = COUNTS;
  const values = new Int16Array(columns * rows * slices);
  for (let n = 0; n < values.length; n++) {
    const x = (n % columns) * SIDE - HALF[0];
    const y = (Math.floor(n / columns) % rows) * SIDE - HALF[1];
    const z = Math.floor(n / columns / rows) * SIDE - HALF[2];
    const inside = [radius(z) - Math.hypot(x - NARROWED, y), 3.5 - Math.hypot(x - STRAIGHT, y)];
    values[n] = Math.hypot(x, y - BONE) < 4 ? 1100 : lumen(Math.max(...inside));
  }
  const axis = (n: number) => `(${[0, 1, 2].map((m) => (m === n ? SIDE : 0)).join()})`;
  const header = [
    'NRRD0004',
    'type: int16',
    'dimension: 3',
    'space: left-posterior-superior',
    `sizes: ${COUNTS.join(' ')}`,
    `space directions: ${[0, 1, 2].map(axis).join(' ')}`,
    `space origin: (${[-HALF[0], -HALF[1], shift - HALF[2]].join()})`,
    'endian: little',
    'encoding: raw',
  ];
  return fileOf(name, Buffer.concat([Buffer.from(`${header.join('\n')}\n\n`), Buffer.from(values.buffer)]));
}

/** Opens the page with the scan in it. */
export async function openScan(viewer: Viewer, scan: MadeFile): Promise<void> {
  await expect(viewer.page.getByRole('button', { name: 'Choose files' })).toBeEnabled();
  await viewer.page.locator('main input[type=file]').first().setInputFiles(scan);
  await viewer.rest();
}

/** Which two of the three axes a slice shows, and which way the second one runs in it. */
const SHOWN: Readonly<Partial<Record<PaneName, readonly [number, number, number]>>> = {
  axial: [0, 1, 1],
  coronal: [0, 2, -1],
  sagittal: [1, 2, -1],
};

/** How long a scan is along each axis (mm). */
const EXTENT = COUNTS.map((count) => count * SIDE) as [number, number, number];

/** The pixel of a place in a slice that shows all of a scan: mm along the slice's axes from its middle. */
export async function pixelAt(
  viewer: Viewer,
  [a, b]: Pair,
  pane: PaneName = 'coronal',
  extent: readonly [number, number, number] = EXTENT,
): Promise<Pair> {
  const [width, height] = await viewer.size(pane);
  const [across, along, sign] = SHOWN[pane] ?? [0, 2, -1];
  const spacing = 1.02 * Math.max((extent[across] ?? 0) / width, (extent[along] ?? 0) / height);
  return [Math.round((width - 1) / 2 + a / spacing), Math.round((height - 1) / 2 + (sign * b) / spacing)];
}

/** Clicks there. */
export async function clickAt(viewer: Viewer, at: Pair, pane: PaneName = 'coronal'): Promise<void> {
  await viewer.click(await pixelAt(viewer, at, pane), pane);
}

/** Traces the tube at `x` between two heights; the list then has this number of vessels. */
export async function traceTube(viewer: Viewer, x: number, [from, to]: Pair, count: number): Promise<void> {
  await clickAt(viewer, [x, from]);
  await expectBegun(viewer);
  await clickAt(viewer, [x, to]);
  await traced(viewer, count);
}
