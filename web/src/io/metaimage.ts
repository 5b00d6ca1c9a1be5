/** MetaImage (.mha, .mhd): always LPS; the rows of TransformMatrix are the directions of i, j, k (as ITK has it). */
import type { Kind, StoredKind } from './numbers';
import type { Place } from './payload';
import { UNSCALED } from './rescale';
import type { Beside, Source } from './source';
import { dataFile, decoded, numberOf, wordsOf } from './text-header';
import type { Affine, Size, VolumeFile } from './volume-file';
import { formatFailure, listed, shown } from './words';

const LONGEST_HEADER = 1 << 16;
const MOST_DIMS = 10;
const LARGEST = 2 ** 40;
const SPACING = ['ElementSpacing', 'ElementSize'];
const ORIGIN = ['Offset', 'Position', 'Origin'];
const DIRECTION = ['TransformMatrix', 'Rotation', 'Orientation'];
const KINDS: Readonly<Record<string, Kind>> = {
  MET_CHAR: 'int8',
  MET_UCHAR: 'uint8',
  MET_SHORT: 'int16',
  MET_USHORT: 'uint16',
  MET_INT: 'int32',
  MET_UINT: 'uint32',
  MET_LONG: 'int32',
  MET_ULONG: 'uint32',
  MET_LONG_LONG: 'int64',
  MET_ULONG_LONG: 'uint64',
  MET_FLOAT: 'float32',
  MET_DOUBLE: 'float64',
};

/** The fields of a header, and the byte behind it. */
class Header {
  constructor(
    readonly path: string,
    readonly fields: ReadonlyMap<string, string>,
    readonly end: number,
  ) {}

  /** Whether one of several fields is there. */
  states(names: readonly string[]): boolean {
    return names.some((name) => this.fields.has(name));
  }

  /** The numbers of the first of several synonymous fields that is there. */
  numbers(names: readonly string[], count: number, otherwise?: readonly number[]): readonly number[] {
    const name = names.find((one) => this.fields.has(one));
    const text = name === undefined ? undefined : this.fields.get(name);
    if (text === undefined && otherwise) {
      return otherwise;
    }
    const values = wordsOf(text ?? '').map((word) => numberOf(word) ?? Number.NaN);
    if (values.length !== count || !values.every(Number.isFinite)) {
      const found = `${names[0]} = ${text === undefined ? 'nothing' : shown(text)}`;
      throw formatFailure(this.path, found, `${count} finite numbers`);
    }
    return values;
  }

  whole(name: string, count: number): readonly number[] {
    const values = this.numbers([name], count);
    if (values.some((value) => !Number.isInteger(value) || Math.abs(value) > LARGEST)) {
      throw formatFailure(this.path, `${name} = ${shown(this.fields.get(name))}`, 'whole numbers');
    }
    return values;
  }

  /** Told as MetaIO does, by the first letter. */
  isTrue(name: string, otherwise = 'False'): boolean {
    return /^[Tt1]/.test(this.fields.get(name) ?? otherwise);
  }
}

/** Reads the header of a MetaImage file. */
export async function openMetaImage(source: Source, beside: Beside): Promise<VolumeFile> {
  const { path } = source;
  const header = readHeader(path, await source.slice(0, LONGEST_HEADER));
  const dims = header.whole('NDims', 1)[0] ?? 0;
  if (dims < 3 || dims > MOST_DIMS) {
    throw formatFailure(path, `NDims = ${dims}`, '3 axes, or more of length 1');
  }
  const size = sizeOf(header, dims);
  const channels = header.fields.get('ElementNumberOfChannels') ?? '1';
  if (channels !== '1') {
    throw formatFailure(path, `${shown(channels)} channels per voxel`, 'one', 'write one channel');
  }
  const notes: string[] = [];
  const stored = storedKind(header);
  const worldFromIndex = affineOf(header, dims, notes);
  const agrees = labelAgrees(header.fields.get('AnatomicalOrientation') ?? '', worldFromIndex, notes);
  noteIntensity(header, notes);
  const place = await placeOf(header, source, beside);
  const states = {
    spacing: header.states(SPACING),
    // A matrix that a label contradicts states two orientations, and none that can be relied on.
    orientation: agrees && header.states([...DIRECTION, 'AnatomicalOrientation']),
  };
  return { path, format: 'MetaImage', size, worldFromIndex, stored, scaling: UNSCALED, place, notes, states };
}

function readHeader(path: string, head: Uint8Array): Header {
  const fields = new Map<string, string>();
  let start = 0;
  while (start < head.length) {
    const found = head.indexOf(10, start);
    const stop = found < 0 ? head.length : found;
    const line = decoded(head.subarray(start, stop));
    const middle = line.search(/[=:]/);
    if (middle < 0) {
      break;
    }
    const name = line.slice(0, middle).trim();
    fields.set(name, line.slice(middle + 1).trim());
    start = stop + 1;
    if (name === 'ElementDataFile') {
      return new Header(path, fields, start);
    }
  }
  throw formatFailure(path, 'a header without ElementDataFile', 'a MetaImage header');
}

function sizeOf(header: Header, dims: number): Size {
  const sizes = header.whole('DimSize', dims);
  const [ni = 0, nj = 0, nk = 0, ...others] = sizes;
  if (others.some((side) => side !== 1) || Math.min(ni, nj, nk) < 1) {
    const found = `DimSize ${shown(listed(sizes))}`;
    throw formatFailure(header.path, found, '3 axes, or more of length 1', 'write one time point');
  }
  return [ni, nj, nk];
}

function storedKind(header: Header): StoredKind {
  const name = header.fields.get('ElementType') ?? '';
  const kind = KINDS[name];
  if (!kind) {
    const expected = `one of ${Object.keys(KINDS).join(', ')}`;
    throw formatFailure(header.path, `ElementType = ${shown(name) || 'nothing'}`, expected);
  }
  return { kind, isBig: header.isTrue('BinaryDataByteOrderMSB') || header.isTrue('ElementByteOrderMSB') };
}

function affineOf(header: Header, dims: number, notes: string[]): Affine {
  if (!header.states(SPACING)) {
    notes.push('no ElementSpacing: 1 mm assumed');
  }
  const spacing = header.numbers(SPACING, dims, new Array(dims).fill(1));
  const origin = header.numbers(ORIGIN, dims, new Array(dims).fill(0));
  const identity = Array.from({ length: dims * dims }, (_, i) => (i % (dims + 1) === 0 ? 1 : 0));
  const matrix = header.numbers(DIRECTION, dims * dims, identity);
  if (spacing.slice(0, 3).some((step) => step <= 0)) {
    throw formatFailure(header.path, `ElementSpacing = ${listed(spacing)}`, 'positive distances in mm');
  }
  const row = (axis: number) => [
    ...[0, 1, 2].map((column) => (matrix[column * dims + axis] ?? 0) * (spacing[column] ?? 1)),
    origin[axis] ?? 0,
  ];
  return [row(0), row(1), row(2), [0, 0, 0, 1]];
}

/** Whether a label (the side on which each axis begins, as ITK writes it) goes with the matrix. */
function labelAgrees(label: string, affine: Affine, notes: string[]): boolean {
  if (!/^[RLAPIS]{3}$/.test(label)) {
    return true;
  }
  const side = (column: number) => {
    const along = affine.slice(0, 3).map((row) => row[column] ?? 0);
    const axis = along.reduce(
      (best, value, i) => (Math.abs(value) > Math.abs(along[best] ?? 0) ? i : best),
      0,
    );
    return ['RL', 'AP', 'IS'][axis]?.[(along[axis] ?? 0) < 0 ? 1 : 0];
  };
  const sides = [0, 1, 2].map(side).join('');
  if (label !== sides) {
    notes.push(`AnatomicalOrientation = ${label}, the matrix says ${sides}: the matrix is used`);
  }
  return label === sides;
}

/** Notes a scaling of the values, which ITK does not apply either. */
function noteIntensity(header: Header, notes: string[]): void {
  for (const [name, neutral] of [
    ['ElementToIntensityFunctionSlope', 1],
    ['ElementToIntensityFunctionOffset', 0],
  ] as const) {
    const stated = header.fields.get(name);
    if (stated !== undefined && numberOf(stated) !== neutral) {
      notes.push(`${name} is not applied, as ITK does not`);
    }
  }
}

/** Where the voxels are. */
async function placeOf(header: Header, source: Source, beside: Beside): Promise<Place> {
  const isBinary = header.isTrue('BinaryData', 'True');
  const isPlain = isBinary && !header.isTrue('CompressedData');
  const codec = !isBinary ? 'text' : isPlain ? 'raw' : 'zlib';
  const name = header.fields.get('ElementDataFile') ?? '';
  if (wordsOf(name)[0] === 'LIST' || name.includes('%')) {
    const found = `ElementDataFile = ${shown(name)}`;
    throw formatFailure(header.path, found, 'voxels in one file', 'write a single .mha');
  }
  const isLocal = name.toUpperCase() === 'LOCAL';
  const data = isLocal ? source : await dataFile(source, name, 'ElementDataFile', beside);
  const before = header.fields.has('HeaderSize') ? (header.whole('HeaderSize', 1)[0] ?? 0) : 0;
  if (before < (isPlain ? -1 : 0) || (isLocal && ![-1, 0, header.end].includes(before))) {
    // ITK counts from the start of the file even there, where nobody else would.
    const expected = '0 or more bytes before the voxels of another file, or -1 with plain voxels';
    throw formatFailure(header.path, `HeaderSize = ${before}`, expected, 'write a single .mha');
  }
  return { source: data, start: isLocal && before >= 0 ? header.end : before, codec, skip: 0 };
}
