/** NIfTI-1 and -2, single files and pairs, gzipped or not: the RAS+ affine becomes LPS, voxels stay. */

import { Failure } from '../core/failure';
import { firstBytes, isGzip } from './inflating';
import { HEADER_BYTES, type NiftiHeader, readHeader } from './nifti-header';
import { mended, placement, statesOf } from './nifti-placement';
import type { Kind } from './numbers';
import type { Place } from './payload';
import { type Scaling, UNSCALED } from './rescale';
import type { Beside, Source } from './source';
import { fileName } from './source';
import type { Size, VolumeFile } from './volume-file';
import { damaged, formatFailure, short } from './words';

const KINDS: Readonly<Record<number, Kind>> = {
  2: 'uint8',
  4: 'int16',
  8: 'int32',
  16: 'float32',
  64: 'float64',
  256: 'int8',
  512: 'uint16',
  768: 'uint32',
  1024: 'int64',
  1280: 'uint64',
};
const COMPLEX = ['complex voxels', 'write their magnitude'] as const;
const COLOUR = ['colour voxels', 'write one channel'] as const;
const OTHER_TYPES: Readonly<Record<number, readonly [string, string]>> = {
  0: ['voxels of no stated type', 'convert the file'],
  1: ['voxels of one bit', 'write bytes'],
  32: COMPLEX,
  1792: COMPLEX,
  2048: COMPLEX,
  128: COLOUR,
  2304: COLOUR,
  1536: ['voxels of 128-bit floats', 'write 64-bit floats'],
};

/** Reads the header of a NIfTI file or of either file of a pair. */
export async function openNifti(source: Source, beside: Beside): Promise<VolumeFile> {
  const { path } = source;
  const home = await partner(source, beside, ['.img', '.hdr']);
  const stated = readHeader(home.path, await firstBytes(home, HEADER_BYTES));
  const kind = kindOf(path, stated.datatype);
  const data = stated.isPair ? await partner(home, beside, ['.hdr', '.img']) : home;
  const notes: string[] = [];
  const skip = offsetOf(path, stated, data === home, notes);
  const size = sizeOf(path, stated);
  const header = mended(stated, notes);
  const worldFromIndex = placement(path, header, size, notes);
  const codec = isGzip(await data.slice(0, 2)) ? 'zlib' : 'raw';
  const place: Place = { source: data, start: 0, codec, skip };
  const stored = { kind, isBig: header.isBig };
  const scaling = scalingOf(path, header);
  const states = statesOf(header);
  const read = { path, format: header.format, size, worldFromIndex, stored, scaling, place, notes, states };
  return { ...read, content: header.description };
}

/** The other file of a pair where this one's name ends as `mine` (`x.img.gz` belongs to `x.hdr.gz` or `x.hdr`). */
async function partner(
  source: Source,
  beside: Beside,
  [mine, other]: readonly [string, string],
): Promise<Source> {
  const zipped = /\.gz$/i.test(source.path) ? '.gz' : '';
  const stem = source.path.slice(0, source.path.length - zipped.length);
  if (!stem.toLowerCase().endsWith(mine)) {
    return source;
  }
  const ending = stem.endsWith(mine.toUpperCase()) ? other.toUpperCase() : other;
  const paths = [zipped, '', '.gz'].map((tail) => stem.slice(0, -mine.length) + ending + tail);
  for (const path of paths) {
    const found = await beside(path);
    if (found) {
      return found;
    }
  }
  const expected = `both files of the pair, ${fileName(source.path)} and ${fileName(paths[0] ?? '')}`;
  throw new Failure('file', source.path, 'one file of a pair', expected, 'choose both files together');
}

/** Refuses by name the types that are no single number. */
function kindOf(path: string, code: number): Kind {
  const kind = KINDS[code];
  if (kind) {
    return kind;
  }
  const [found, mend] = OTHER_TYPES[code] ?? [`voxels of the unknown type ${code}`, 'convert the file'];
  throw formatFailure(path, found, 'one integer or float of up to 64 bits per voxel', mend);
}

/** The first byte of the voxels, which in a single file lie behind the header. */
function offsetOf(path: string, header: NiftiHeader, isSingle: boolean, notes: string[]): number {
  const behind = header.format === 'NIfTI-1' ? 352 : 544;
  if (isSingle && header.voxOffset === 0) {
    notes.push(`vox_offset is 0: ${behind} assumed, where the header ends`);
    return behind;
  }
  const least = isSingle ? behind : 0;
  if (!Number.isInteger(header.voxOffset) || header.voxOffset < least) {
    throw damaged(path, `vox_offset ${short(header.voxOffset)}`, `a whole number from ${least}`);
  }
  return header.voxOffset;
}

function sizeOf(path: string, header: NiftiHeader): Size {
  const shape = shapeOf(header);
  const written = `(${shape.join(', ')}${shape.length === 1 ? ',' : ''})`;
  if (shape.length > 3 && (shape[3] ?? 1) > 1) {
    throw formatFailure(path, `${shape[3]} time points`, 'one', 'write one time point');
  }
  if (shape.slice(3).some((length) => length !== 1)) {
    throw formatFailure(
      path,
      `several components per voxel (shape ${written})`,
      'one',
      'write one component',
    );
  }
  const [ni, nj, nk] = shape;
  if (ni === undefined || nj === undefined || nk === undefined || Math.min(ni, nj, nk) < 1) {
    throw formatFailure(path, `shape ${written}`, '3 axes, none empty');
  }
  return [ni, nj, nk];
}

/** The lengths of the axes; FreeSurfer writes some that a header cannot hold otherwise. */
function shapeOf({ dim, glmin, format }: NiftiHeader): number[] {
  const [count = 0, ...lengths] = dim;
  const shape = count >= 1 && count <= 7 ? lengths.slice(0, count) : [0];
  if (format === 'NIfTI-2') {
    return shape;
  }
  const start = shape.slice(0, 3).join();
  if (start === '-1,1,1') {
    return [glmin, ...shape.slice(1)];
  }
  return start === '27307,1,6' ? [163842, 1, 1, ...shape.slice(3)] : shape;
}

function scalingOf(path: string, { slope, intercept }: NiftiHeader): Scaling {
  if (!Number.isFinite(slope) || slope === 0) {
    return UNSCALED;
  }
  if (!Number.isFinite(intercept)) {
    const found = `scl_slope ${short(slope)} and scl_inter ${short(intercept)}`;
    throw formatFailure(path, found, 'finite numbers');
  }
  return { slope, intercept };
}
