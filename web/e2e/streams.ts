/** Voxel streams as sent by `lumencut view`: of a straight and a bent tube, complete and broken. */
import type { Page } from '@playwright/test';

export interface StreamParts {
  readonly size: readonly [number, number, number];
  readonly dtype: string;
  readonly world_from_index: readonly (readonly number[])[];
  readonly notes: readonly string[];
  readonly name: string;
}

/** A volume of 96 × 88 × 32 voxels of 1 mm. If it were mirrored, its centerline would lie outside. */
export const VOLUME: StreamParts = {
  size: [96, 88, 32],
  dtype: 'int16',
  world_from_index: [
    [1, 0, 0, 10],
    [0, 1, 0, 20],
    [0, 0, 1, -16],
    [0, 0, 0, 1],
  ],
  notes: [],
  name: 'made for a test',
};

export function header(parts: object, magic = 'LCVOLUME', text = JSON.stringify(parts)): Buffer {
  const bytes = Buffer.from(text);
  const padded = Buffer.concat([bytes, Buffer.alloc((16 - ((12 + bytes.length) % 16)) % 16, 0x20)]);
  const length = Buffer.alloc(4);
  length.writeUInt32LE(padded.length);
  return Buffer.concat([Buffer.from(magic, 'latin1'), length, padded]);
}

/** Voxels of a tube of 350 HU along z in fat, next to bone that becomes denser towards the back. */
export function voxels({ size: [columns, rows, slices] }: StreamParts): Buffer {
  const values = new Int16Array(columns * rows * slices);
  for (let n = 0; n < values.length; n++) {
    const [x, y] = [(n % columns) - columns / 2, (Math.floor(n / columns) % rows) - rows / 2];
    values[n] = Math.hypot(x, y) < 5 ? 350 : Math.abs(x) > 20 ? 100 + 6 * (y + rows / 2) : -100;
  }
  return Buffer.from(values.buffer);
}

export const WHOLE = Buffer.concat([header(VOLUME), voxels(VOLUME)]);

export const CENTERLINE = `# vtk DataFile Version 3.0
axis
ASCII
DATASET POLYDATA
POINTS 3 float
58 64 -15 58 64 0 58 64 14
LINES 1 4
3 0 1 2
`;

/** Radii of an arc and of the tube along it (mm), and the directions in which the arc begins and bends. */
const [ARC, TUBE] = [26, 3.5];
const AHEAD = [0, 0, 1] as const;
const BEND = [0.6, 0.8, 0] as const;
/** The arc begins at this distance from the first voxel (mm). */
const MARGIN = 10;

/** A tube along a quarter of a circle and beyond it, in voxels of 0.8 mm. */
export const BENT_VOLUME: StreamParts = {
  size: [48, 54, 62],
  dtype: 'int16',
  world_from_index: [
    [0.8, 0, 0, 0],
    [0, 0.8, 0, 0],
    [0, 0, 0.8, 0],
    [0, 0, 0, 1],
  ],
  notes: [],
  name: 'bent tube',
};

/** Position at an angle (degrees) of the arc. */
function onArc(degrees: number): number[] {
  const angle = (degrees * Math.PI) / 180;
  const [ahead, aside] = [ARC * Math.sin(angle), ARC * (1 - Math.cos(angle))];
  return AHEAD.map((part, n) => MARGIN + ahead * part + aside * (BEND[n] ?? 0));
}

function bentVoxels(): Buffer {
  const [columns, rows, slices] = BENT_VOLUME.size;
  const values = new Int16Array(columns * rows * slices);
  for (let n = 0; n < values.length; n++) {
    const index = [n % columns, Math.floor(n / columns) % rows, Math.floor(n / columns / rows)];
    const [x, y, z] = index.map((count) => 0.8 * count - MARGIN) as [number, number, number];
    const aside = x * BEND[0] + y * BEND[1];
    const away = Math.hypot(Math.hypot(z, aside - ARC) - ARC, y * BEND[0] - x * BEND[1]);
    // The edge of the lumen (350) is as wide as a voxel.
    values[n] = 60 + 290 * Math.min(Math.max(0.5 + (TUBE - away) / 0.8, 0), 1);
  }
  return Buffer.concat([header(BENT_VOLUME), Buffer.from(values.buffer)]);
}

/** The end of the second vessel of the bent tube (degrees). */
const END = 110;

/** The scan of the bent tube, and centerlines of its two vessels: from 0° to `split`, and from there on. */
function bentTube(split = 90): { readonly volume: Buffer; readonly lines: string } {
  const numbers = Array.from({ length: END + 1 }, (_, n) => n);
  const lines = [numbers.slice(0, split + 1), numbers.slice(split)].map((line) => [line.length, ...line]);
  const text = `# vtk DataFile Version 3.0
axis
ASCII
DATASET POLYDATA
POINTS ${numbers.length} float
${numbers.map((at) => onArc(at).join(' ')).join('\n')}
LINES 2 ${lines.flat().length}
${lines.map((line) => line.join(' ')).join('\n')}
`;
  return { volume: bentVoxels(), lines: text };
}

/** Length, distance of the ends (mm) and tortuosity of a share of the first 90° of the bent tube. */
export function arcOf(share: number): readonly [number, number, number] {
  const angle = (share * Math.PI) / 2;
  const [length, straight] = [ARC * angle, 2 * ARC * Math.sin(angle / 2)];
  return [length, straight, length / straight];
}

/** Opens the bent tube with its two vessels in a page. */
export async function openBentTube(page: Page, split?: number): Promise<void> {
  const { volume, lines } = bentTube(split);
  await page.route('**/made/volume', (route) => route.fulfill({ body: volume }));
  await page.route('**/made/axis.vtk', (route) => route.fulfill({ body: lines }));
  await page.goto('./?volume=made/volume&centerlines=made/axis.vtk&device=cpu&test');
}
