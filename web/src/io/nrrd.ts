/** NRRD (.nrrd, .nhdr): its space becomes LPS, voxels stay as they are. */
import { type Direction, LONGEST_HEADER, type NrrdHeader, readHeader } from './nrrd-header';
import type { Kind, StoredKind } from './numbers';
import { byteCount } from './numbers';
import type { Codec, Place } from './payload';
import { UNSCALED } from './rescale';
import { labelsOf, segmentsOf } from './segments';
import type { Beside, Source } from './source';
import { dataFile, wordsOf } from './text-header';
import type { Affine, Size, VolumeFile } from './volume-file';
import { formatFailure, listed, shown } from './words';

const CODECS: Readonly<Record<string, Codec>> = {
  raw: 'raw',
  gzip: 'zlib',
  gz: 'zlib',
  ascii: 'text',
  text: 'text',
  txt: 'text',
};
const NAMES: readonly (readonly [Kind, string])[] = [
  ['int8', 'signed char, int8, int8_t'],
  ['uint8', 'uchar, unsigned char, uint8, uint8_t'],
  ['int16', 'short, short int, signed short, signed short int, int16, int16_t'],
  ['uint16', 'ushort, unsigned short, unsigned short int, uint16, uint16_t'],
  ['int32', 'int, signed int, int32, int32_t'],
  ['uint32', 'uint, unsigned int, uint32, uint32_t'],
  ['int64', 'longlong, long long, long long int, signed long long, signed long long int, int64, int64_t'],
  ['uint64', 'ulonglong, unsigned long long, unsigned long long int, uint64, uint64_t'],
  ['float32', 'float'],
  ['float64', 'double'],
];
const KINDS = new Map(
  NAMES.flatMap(([kind, names]) => names.split(', ').map((name) => [name, kind] as const)),
);
const TO_LPS: Readonly<Record<string, readonly [number, number, number]>> = {
  'left-posterior-superior': [1, 1, 1],
  'right-anterior-superior': [-1, -1, 1],
  'left-anterior-superior': [1, -1, 1],
};
const IN_FULL: Readonly<Record<string, string>> = {
  lps: 'left-posterior-superior',
  ras: 'right-anterior-superior',
  las: 'left-anterior-superior',
};
const MILLIMETRES: Readonly<Record<string, number>> = {
  mm: 1,
  millimeter: 1,
  cm: 10,
  m: 1000,
  um: 0.001,
  µm: 0.001,
  micron: 0.001,
};
const GRID_KINDS = ['domain', 'space', 'none', '???', ''];

/** Reads the header of an NRRD file, attached or detached. */
export async function openNrrd(source: Source, beside: Beside): Promise<VolumeFile> {
  const { path } = source;
  const header = readHeader(path, await source.slice(0, LONGEST_HEADER));
  const notes: string[] = [];
  const sizes = header.required('sizes') && header.whole('sizes');
  const directions = header.has('space directions') ? header.directions('space directions') : null;
  const { axes, layers } = axesAndLayers(header, sizes || [], directions);
  const size = axes.map((axis) => sizes[axis] ?? 0) as unknown as Size;
  const stored = storedKind(header);
  const worldFromIndex = affineOf(header, axes, directions, notes);
  const place = await placeOf(header, source, beside);
  const states = {
    spacing: statesSpacing(header, axes),
    orientation: directions !== null && toLps(header) !== null,
  };
  const labels =
    header.segmentLines.length > 0
      ? labelsOf(path, stored, segmentsOf(header.segmentLines, layers), layers)
      : null;
  const read = {
    path,
    format: 'NRRD',
    size,
    worldFromIndex,
    stored,
    scaling: UNSCALED,
    place,
    notes,
    states,
    labels,
  };
  return { ...read, content: header.content };
}

/** The three axes of the grid, and the length of a first one: 1 but for a segmentation in layers. */
function axesAndLayers(
  header: NrrdHeader,
  sizes: readonly number[],
  directions: readonly Direction[] | null,
): { axes: number[]; layers: number } {
  const dimension = header.required('dimension') && header.whole('dimension')[0];
  if (sizes.length !== dimension || sizes.length < 3 || Math.min(...sizes) < 1) {
    throw formatFailure(header.path, `sizes: ${shown(listed(sizes))}`, '3 axes, none empty');
  }
  const every = sizes.map((_, axis) => axis);
  let axes = every;
  if (directions && directions.length === sizes.length) {
    axes = every.filter((axis) => directions[axis]);
  } else if (sizes.length > 3) {
    axes = every.filter((axis) => (sizes[axis] ?? 1) > 1 || sizes.length - axis <= 3).slice(0, 3);
  }
  const others = every.filter((axis) => !axes.slice(0, 3).includes(axis));
  const kinds = wordsOf(header.text('kinds'));
  const layers = header.segmentLines.length > 0 && others.includes(0) ? (sizes[0] ?? 1) : 1;
  if (axes.length !== 3 || others.some((axis) => sizes[axis] !== 1 && !(axis === 0 && layers > 1))) {
    const stated = shown(kinds.join(' ')) || 'not stated';
    const found = `several values per voxel or time points (sizes: ${shown(listed(sizes))}, kinds: ${stated})`;
    throw formatFailure(header.path, found, '3 axes with a direction', 'write one component or time point');
  }
  const odd = axes
    .map((axis) => kinds[axis] ?? 'domain')
    .find((kind) => !GRID_KINDS.includes(kind.toLowerCase()));
  if (odd !== undefined) {
    throw formatFailure(
      header.path,
      `an axis of kind ${shown(odd)}`,
      'domain or space axes',
      'write one component',
    );
  }
  return { axes, layers };
}

function storedKind(header: NrrdHeader): StoredKind {
  const name = header.required('type').toLowerCase();
  const kind = KINDS.get(name);
  if (!kind) {
    throw formatFailure(header.path, `type: ${shown(name)}`, 'an integer or float type');
  }
  const endian = header.text('endian').toLowerCase();
  const isText = CODECS[header.text('encoding').toLowerCase()] === 'text';
  if (byteCount(kind) > 1 && !isText && endian !== 'little' && endian !== 'big') {
    throw formatFailure(header.path, `endian: ${shown(endian) || 'nothing'}`, 'little or big');
  }
  return { kind, isBig: endian === 'big' };
}

function affineOf(
  header: NrrdHeader,
  axes: readonly number[],
  directions: readonly Direction[] | null,
  notes: string[],
): Affine {
  const columns = directions ? axes.map((axis) => directions[axis] ?? []) : spacings(header, axes, notes);
  const odd = columns.find((column) => column.length !== 3);
  if (odd) {
    throw formatFailure(header.path, `space directions: ${odd.length} numbers`, '3 numbers per axis');
  }
  const origin = originOf(header, notes);
  const unit = millimetres(header, notes);
  const signs = signsOf(header, notes);
  const row = (axis: 0 | 1 | 2) =>
    [...columns.map((column) => column[axis] ?? 0), origin[axis] ?? 0].map(
      (value) => value * unit * signs[axis],
    );
  return [row(0), row(1), row(2), [0, 0, 0, 1]];
}

/** The directions of a header that states distances alone. */
function spacings(header: NrrdHeader, axes: readonly number[], notes: string[]): number[][] {
  const stated = header.numbers('spacings');
  const steps = axes.map((axis) => stated[axis] ?? Number.NaN);
  if (!steps.every(Number.isFinite)) {
    notes.push('no spacing stated: 1 mm assumed');
  }
  return steps.map((step, axis) =>
    [0, 1, 2].map((i) => (i === axis ? (Number.isFinite(step) ? step : 1) : 0)),
  );
}

/** Whether lengths in mm are known: stated, and not in a unit that nobody knows. */
function statesSpacing(header: NrrdHeader, axes: readonly number[]): boolean {
  const stated = header.numbers('spacings');
  const isStated = header.has('space directions') || axes.every((axis) => Number.isFinite(stated[axis]));
  const unit = unitOf(header);
  return isStated && (unit === '' || unit in MILLIMETRES);
}

function originOf(header: NrrdHeader, notes: string[]): readonly number[] {
  if (!header.has('space origin')) {
    const unused = header.has('axis mins') ? ', axis mins are not used' : '';
    notes.push(`no space origin stated${unused}: (0, 0, 0) assumed`);
    return [0, 0, 0];
  }
  const origin = header.directions('space origin')[0] ?? [];
  if (origin.length !== 3) {
    throw formatFailure(header.path, `space origin: ${origin.length} numbers`, '3 numbers');
  }
  return origin;
}

/** What turns the file's space into LPS, null for one that names no patient axes. */
function toLps(header: NrrdHeader): readonly [number, number, number] | null {
  const stated = patientSpace(header);
  return TO_LPS[IN_FULL[stated] ?? stated] ?? null;
}

function patientSpace(header: NrrdHeader): string {
  return header
    .text('space')
    .toLowerCase()
    .replace(/-time$/, '');
}

/** The same, LPS where nothing is known. */
function signsOf(header: NrrdHeader, notes: string[]): readonly [number, number, number] {
  const signs = toLps(header);
  if (signs) {
    return signs;
  }
  const stated = shown(patientSpace(header));
  notes.push(
    stated ? `space '${stated}' names no patient axes: LPS assumed` : 'no space stated: LPS assumed',
  );
  return [1, 1, 1];
}

/** The unit of the first axis of the space, in the singular where that is known; empty for none. */
function unitOf(header: NrrdHeader): string {
  const stated = (header.words('space units')[0] ?? '').trim().toLowerCase();
  const singular = stated.replace(/s$/, '');
  const unit = !(stated in MILLIMETRES) && singular in MILLIMETRES ? singular : stated;
  return unit === '???' ? '' : unit;
}

/** Millimetres per unit of the file. */
function millimetres(header: NrrdHeader, notes: string[]): number {
  const unit = unitOf(header);
  const factor = unit === '' ? 1 : MILLIMETRES[unit];
  if (factor === undefined) {
    notes.push(`space units '${shown(unit)}' are not known: mm assumed`);
  } else if (factor !== 1) {
    notes.push(`lengths are in ${unit}: converted to mm`);
  }
  return factor ?? 1;
}

/** Where the voxels are. */
async function placeOf(header: NrrdHeader, source: Source, beside: Beside): Promise<Place> {
  const encoding = header.required('encoding').toLowerCase();
  const codec = CODECS[encoding];
  if (!codec) {
    const mend = 'write it with encoding gzip or raw';
    throw formatFailure(header.path, `encoding: ${shown(encoding)}`, 'raw, ascii or gzip', mend);
  }
  const [lines = 0] = header.whole('line skip');
  const [skip = 0] = header.whole('byte skip');
  if (lines < 0) {
    throw formatFailure(header.path, `line skip: ${lines}`, '0 or more lines');
  }
  if (skip < (encoding === 'raw' ? -1 : 0)) {
    throw formatFailure(header.path, `byte skip: ${skip}`, '0 or more bytes, or -1 with encoding raw');
  }
  const isAttached = !header.has('data file');
  const data = isAttached ? source : await detached(header, source, beside);
  if (skip === -1) {
    return { source: data, start: -1, codec, skip: 0 };
  }
  return { source: data, start: await afterLines(data, isAttached ? header.end : 0, lines), codec, skip };
}

function detached(header: NrrdHeader, source: Source, beside: Beside): Promise<Source> {
  const name = header.text('data file');
  if (wordsOf(name)[0] === 'LIST' || name.includes('%')) {
    const found = `data file: ${shown(name)}`;
    throw formatFailure(header.path, found, 'voxels in one file', 'write a single .nrrd');
  }
  return dataFile(source, name, 'data file', beside);
}

/** The byte behind some lines that are to be left out. */
async function afterLines(source: Source, start: number, lines: number): Promise<number> {
  let [at, left] = [start, lines];
  while (left > 0 && at < source.size) {
    const chunk = await source.slice(at, at + LONGEST_HEADER);
    let place = 0;
    while (left > 0 && place < chunk.length) {
      const found = chunk.indexOf(10, place);
      left -= found < 0 ? 0 : 1;
      place = found < 0 ? chunk.length : found + 1;
    }
    at += place;
  }
  return at;
}
