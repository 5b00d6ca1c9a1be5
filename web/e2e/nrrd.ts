/** Makes a scan file of 16-bit values on a regular grid. */
import { fileOf, type MadeFile } from './controls';

type Triple = readonly [number, number, number];

interface Grid {
  /** Voxels along the axes, and their side (mm). */
  readonly counts: Triple;
  readonly side: number;
  /** The middle of the grid (mm, LPS). */
  readonly middle: Triple;
}

/** `value` returns the value (HU) at a place from the middle of the grid (mm). */
export function nrrd(
  name: string,
  { counts, side, middle }: Grid,
  value: (x: number, y: number, z: number) => number,
): MadeFile {
  const [columns, rows, slices] = counts;
  const half = (count: number): number => ((count - 1) * side) / 2;
  const values = new Int16Array(columns * rows * slices);
  for (let n = 0; n < values.length; n++) {
    const x = (n % columns) * side - half(columns);
    const y = (Math.floor(n / columns) % rows) * side - half(rows);
    const z = Math.floor(n / columns / rows) * side - half(slices);
    values[n] = value(x, y, z);
  }
  const axis = (n: number) => `(${[0, 1, 2].map((m) => (m === n ? side : 0)).join()})`;
  const header = [
    'NRRD0004',
    'type: int16',
    'dimension: 3',
    'space: left-posterior-superior',
    `sizes: ${counts.join(' ')}`,
    `space directions: ${[0, 1, 2].map(axis).join(' ')}`,
    `space origin: (${middle.map((part, n) => part - half(counts[n] ?? 1)).join()})`,
    'endian: little',
    'encoding: raw',
  ];
  return fileOf(name, Buffer.concat([Buffer.from(`${header.join('\n')}\n\n`), Buffer.from(values.buffer)]));
}
