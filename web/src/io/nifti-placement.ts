/** Where a NIfTI header places its grid: the sform, shear and all, else the qform, else centred at the origin. */
import type { States } from '../core/messages';
import type { NiftiHeader } from './nifti-header';
import type { Affine, Size } from './volume-file';
import { formatFailure, short, shown } from './words';

const MILLIMETRES: Readonly<Record<number, readonly [string, number]>> = {
  1: ['meter', 1000],
  2: ['mm', 1],
  3: ['micron', 0.001],
};
/** Codes of the unit of time, which stand in the same field. */
const TIMES = [0, 8, 16, 24, 32, 40, 48];
const MOST_CODE = 5;
/** How far from 1 the square of a quaternion may be, by the precision in which it is stored. */
const TOLERANCE = { 'NIfTI-1': 3 * 2 ** -23, 'NIfTI-2': 3 * Number.EPSILON } as const;
/** Placements that lie further apart are told of (mm). */
const APART = 0.01;
const SAME_AXIS = Math.cos((25 * Math.PI) / 180);

/** A header whose lengths and codes can be relied on; what was mended is noted, in nibabel's words. */
export function mended(header: NiftiHeader, notes: string[]): NiftiHeader {
  const [first, ...lengths] = header.pixdim;
  const sides = lengths.slice(0, 3);
  const [hasZero, hasNegative] = [sides.some((side) => side === 0), sides.some((side) => side < 0)];
  if (hasZero || hasNegative) {
    const faults = [
      hasZero && 'pixdim[1,2,3] should be non-zero',
      hasNegative && 'pixdim[1,2,3] should be positive',
    ];
    const mends = [hasZero && 'setting 0 dims to 1', hasNegative && 'setting to abs of pixdim values'];
    const said = [faults, mends].map((words) => words.filter(Boolean).join(' and '));
    notes.push(shown(said.join('; ')));
  }
  const code = (name: string, stated: number) => {
    const isKnown = stated >= 0 && stated <= MOST_CODE;
    if (!isKnown) {
      notes.push(`${name} ${stated} not valid; setting to 0`);
    }
    return isKnown ? stated : 0;
  };
  return {
    ...header,
    pixdim: [first === -1 ? -1 : 1, ...lengths.map((side) => (side === 0 ? 1 : Math.abs(side)))],
    qformCode: code('qform_code', header.qformCode),
    sformCode: code('sform_code', header.sformCode),
  };
}

/** World (LPS, mm) from index, of a header that is mended. */
export function placement(path: string, header: NiftiHeader, size: Size, notes: string[]): Affine {
  const millimetres = unit(header, notes);
  const ras = bestAffine(path, header, size);
  noteForms(header, size, notes);
  const sign = [-millimetres, -millimetres, millimetres];
  return [...ras.map((row, i) => row.map((value) => value * (sign[i] ?? 1))), [0, 0, 0, 1]];
}

function bestAffine(path: string, header: NiftiHeader, size: Size): Affine {
  if (header.sformCode !== 0) {
    return header.rows;
  }
  if (header.qformCode === 0) {
    return centred(header, size);
  }
  const affine = qform(header);
  if (affine === null) {
    throw formatFailure(path, 'a qform that is no rotation', 'a unit quaternion', 'state an sform');
  }
  return affine;
}

/** The grid centred at the origin, i to the left. */
function centred({ pixdim }: NiftiHeader, size: Size): Affine {
  const sides = [-(pixdim[1] ?? 1), pixdim[2] ?? 1, pixdim[3] ?? 1];
  return sides.map((side, i) => {
    const row = [0, 0, 0, (-side * ((size[i] ?? 1) - 1)) / 2];
    row[i] = side;
    return row;
  });
}

/** The placement by the quaternion, null where it is no rotation. */
function qform({ format, quaternion, pixdim, offset }: NiftiHeader): Affine | null {
  const [x, y, z] = quaternion as [number, number, number];
  const square = 1 - (x * x + y * y + z * z);
  const isNothing = Math.abs(square) < TOLERANCE[format];
  if (!isNothing && !(square > 0)) {
    return null;
  }
  const w = isNothing ? 0 : Math.sqrt(square);
  const double = 2 / (w * w + x * x + y * y + z * z);
  const rotation = [
    [1 - double * (y * y + z * z), double * (x * y - w * z), double * (x * z + w * y)],
    [double * (x * y + w * z), 1 - double * (x * x + z * z), double * (y * z - w * x)],
    [double * (x * z - w * y), double * (y * z + w * x), 1 - double * (x * x + y * y)],
  ];
  const sides = [pixdim[1] ?? 1, pixdim[2] ?? 1, (pixdim[3] ?? 1) * (pixdim[0] ?? 1)];
  return rotation.map((row, i) => [...row.map((value, j) => value * (sides[j] ?? 1)), offset[i] ?? 0]);
}

/** The unit of length that the header states, and its millimetres; null where it states none that is known. */
function unitOf(header: NiftiHeader): readonly [string, number] | null {
  const code = header.units % 8;
  return TIMES.includes(header.units - code) ? (MILLIMETRES[code] ?? null) : null;
}

/** Millimetres per unit of length, 1 where none is stated. */
function unit(header: NiftiHeader, notes: string[]): number {
  const stated = unitOf(header);
  if (!stated) {
    notes.push('the unit of length is not stated: mm assumed');
    return 1;
  }
  if (stated[0] !== 'mm') {
    notes.push(`lengths are in ${stated[0]}s: converted to mm`);
  }
  return stated[1];
}

/**
 * Whether lengths in mm are known, and the patient's sides. Lengths of a placement are mm by convention; the sides are
 * not known where two placements turn an axis more than 25 degrees apart.
 */
export function statesOf(header: NiftiHeader): States {
  const isPlaced = header.sformCode > 0 || header.qformCode > 0;
  const spacing = isPlaced || unitOf(header) !== null;
  if (!(header.sformCode > 0 && header.qformCode > 0)) {
    return { spacing, orientation: isPlaced };
  }
  const other = qform(header);
  const isAlike = (axis: number) => {
    const [one, two] = [header.rows, other ?? header.rows].map((rows) => rows.map((row) => row[axis] ?? 0));
    const dot = (a: readonly number[] = [], b: readonly number[] = []) =>
      a.reduce((sum, v, i) => sum + v * (b[i] ?? 0), 0);
    return dot(one, two) / Math.sqrt(dot(one, one) * dot(two, two)) > SAME_AXIS;
  };
  return { spacing, orientation: [0, 1, 2].every(isAlike) };
}

/** Notes a missing placement, or two that contradict each other. */
function noteForms(header: NiftiHeader, size: Size, notes: string[]): void {
  if (header.sformCode === 0 && header.qformCode === 0) {
    const assumed = 'centred at the origin, i to the left, like nibabel';
    notes.push(`no placement (qform_code = sform_code = 0): ${assumed}`);
  }
  if (header.sformCode === 0 || header.qformCode === 0) {
    return;
  }
  const other = qform(header);
  if (other === null) {
    notes.push('the qform is no rotation: the sform is used');
    return;
  }
  const apart = farthest(header.rows, other, size);
  if (!(apart <= APART)) {
    notes.push(`sform and qform lie up to ${short(Number(apart.toPrecision(3)))} apart: the sform is used`);
  }
}

/** How far apart two placements put a corner of the grid, along one axis. */
function farthest(one: Affine, other: Affine, size: Size): number {
  let apart = 0;
  for (const corner of [0, 1, 2, 3, 4, 5, 6, 7]) {
    const index = [0, 1, 2].map((axis) => ((corner >> axis) & 1) * (size[axis] ?? 0));
    for (const [i, row] of one.entries()) {
      const terms = row.map((value, j) => (value - (other[i]?.[j] ?? 0)) * (index[j] ?? 1));
      apart = Math.max(apart, Math.abs(terms.reduce((sum, term) => sum + term, 0)));
    }
  }
  return apart;
}
