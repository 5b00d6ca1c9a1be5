/** Creates a scan file for page and command line: two separate tubes, one with a stenosis, in front of bone. */
import { expect } from '@playwright/test';
import type { Pair } from '../src/core/messages';
import { expectBegun, type MadeFile, traced } from './controls';
import { nrrd } from './nrrd';
import type { PaneName, Viewer } from './page';

/** Numbers of voxels along the axes, and voxel size (mm); the centre of the volume is at 0. */
const COUNTS = [80, 56, 90] as const;
const SIDE = 0.8;

/** Positions of the two tubes (mm to the patient's left), and depth of the bone (mm towards the back). */
export const NARROWED = -12;
export const STRAIGHT = 12;
export const BONE = 15;

const radius = (z: number): number => 4 - 2 * Math.exp(-((z / 6) ** 2));

/** Value (HU) at a depth in the lumen (mm): 350 inside, -100 outside, with a blurred edge. */
const lumen = (inside: number): number => -100 + 450 * Math.min(Math.max(0.5 + inside / 1.6, 0), 1);

/** Value (HU) of bone at a place (mm from the centre); null outside. */
type Bone = (x: number, y: number, z: number) => number | null;

/** A rod as smooth as a vessel. */
const rod: Bone = (x, y) => (Math.hypot(x, y - BONE) < 4 ? 1100 : null);

/** A block of marrow in a shell, like a vertebra. */
export const vertebra: Bone = (x, y, z) => {
  const depth = Math.min(7 - Math.abs(x), 8 - Math.abs(y - BONE + 3), 25 - Math.abs(z));
  return depth < 0 ? null : depth < 2.5 ? 900 : 150;
};

/** The scan file. `shift` moves the whole scan along the patient (mm), which gives it another grid. `as` changes all values. */
export const tubes = (
  name: string,
  shift = 0,
  bone: Bone = rod,
  as: (value: number) => number = (value) => value,
): MadeFile =>
  nrrd(name, { counts: COUNTS, side: SIDE, middle: [0, 0, shift] }, (x, y, z) => {
    const inside = [radius(z) - Math.hypot(x - NARROWED, y), 3.5 - Math.hypot(x - STRAIGHT, y)];
    return as(bone(x, y, z) ?? lumen(Math.max(...inside)));
  });

/** Brightness of a projection at a place (mm to the patient's left, at half the height). */
export async function brightness(viewer: Viewer, x: number): Promise<number> {
  const { width, height, bytes } = await viewer.picture();
  const { pixel_spacing, size } = await viewer.camera();
  const column = Math.round((width - 1) / 2 + (x / pixel_spacing) * (width / size[0]));
  return bytes[4 * (Math.round((height - 1) / 2) * width + column)] ?? 0;
}

export async function openScan(viewer: Viewer, scan: MadeFile): Promise<void> {
  await expect(viewer.page.getByRole('button', { name: 'Choose files' })).toBeEnabled();
  await viewer.page.locator('main input[type=file]').first().setInputFiles(scan);
  await viewer.rest();
}

/** The two axes that a slice shows, and the direction of the second one. */
const SHOWN: Readonly<Partial<Record<PaneName, readonly [number, number, number]>>> = {
  axial: [0, 1, 1],
  coronal: [0, 2, -1],
  sagittal: [1, 2, -1],
};

const EXTENT = COUNTS.map((count) => count * SIDE) as [number, number, number];

/** Pixel of a position in a slice that shows the whole scan (mm from its centre). */
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

export async function clickAt(viewer: Viewer, at: Pair, pane: PaneName = 'coronal'): Promise<void> {
  await viewer.click(await pixelAt(viewer, at, pane), pane);
}

export async function traceTube(viewer: Viewer, x: number, [from, to]: Pair, count: number): Promise<void> {
  await clickAt(viewer, [x, from]);
  await expectBegun(viewer);
  await clickAt(viewer, [x, to]);
  await traced(viewer, count);
}
