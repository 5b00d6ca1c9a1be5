/** Voxel streams as sent by `lumencut view`, complete and broken. */

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
