/** The fields of NIfTI-1 and -2 headers. */
import { formatFailure } from './words';

/** Bytes that hold either header. */
export const HEADER_BYTES = 540;

/** What a header states; numbers are those of the file. */
export interface NiftiHeader {
  readonly format: 'NIfTI-1' | 'NIfTI-2';
  /** Whether the voxels are in a file of their own. */
  readonly isPair: boolean;
  readonly isBig: boolean;
  /** How many axes, and their lengths. */
  readonly dim: readonly number[];
  readonly glmin: number;
  readonly datatype: number;
  /** The handedness, then the lengths of voxels. */
  readonly pixdim: readonly number[];
  readonly voxOffset: number;
  readonly slope: number;
  readonly intercept: number;
  readonly units: number;
  readonly qformCode: number;
  readonly sformCode: number;
  /** b, c, d of the quaternion, then the offset. */
  readonly quaternion: readonly number[];
  readonly offset: readonly number[];
  readonly rows: readonly (readonly number[])[];
  /** What the file says that it holds. */
  readonly description: string;
}

const LENGTHS = { 348: 'NIfTI-1', 540: 'NIfTI-2' } as const;
const PACKED: readonly (readonly [string, readonly number[]])[] = [
  ['bzip2', [0x42, 0x5a, 0x68]],
  ['xz', [0xfd, 0x37, 0x7a, 0x58, 0x5a, 0]],
  ['zstd', [0x28, 0xb5, 0x2f, 0xfd]],
  ['zip', [0x50, 0x4b, 3, 4]],
];

function viewOf(head: Uint8Array): DataView {
  return new DataView(head.buffer, head.byteOffset, head.byteLength);
}

/** The format that the first bytes of a file announce. */
export function niftiKind(head: Uint8Array): NiftiHeader['format'] | null {
  if (head.length < 4) {
    return null;
  }
  const view = viewOf(head);
  const length = [view.getInt32(0, true), view.getInt32(0, false)].find((found) => found in LENGTHS);
  return length === undefined ? null : LENGTHS[length as keyof typeof LENGTHS];
}

/** Reads the header of a file of this name, of its first bytes. */
export function readHeader(path: string, head: Uint8Array): NiftiHeader {
  const packed = PACKED.find(([, magic]) => magic.every((byte, at) => head[at] === byte));
  if (packed) {
    const found = `a file compressed with ${packed[0]}`;
    throw formatFailure(path, found, 'a plain or gzipped file', 'decompress it first');
  }
  const format = niftiKind(head);
  const start = format === 'NIfTI-1' ? 344 : 4;
  const magic = String.fromCharCode(...head.subarray(start, start + 3));
  if (format === null || !/^n[+i][12]$/.test(magic)) {
    const found = format === null ? 'no NIfTI header' : 'an Analyze 7.5 header, which states no space';
    throw formatFailure(path, found, 'a NIfTI file', 'convert it to NIfTI');
  }
  const length = format === 'NIfTI-1' ? 348 : 540;
  if (head.length < length) {
    throw formatFailure(path, `${head.length} bytes`, `a header of ${length} bytes`, 'copy the file again');
  }
  const read = format === 'NIfTI-1' ? firstHeader : secondHeader;
  return { format, isPair: magic[1] === 'i', ...read(viewOf(head)) };
}

type Fields = Omit<NiftiHeader, 'format' | 'isPair'>;

/** Numbers that stand one after the other. */
function several(count: number, step: number, at: number, read: (at: number) => number): number[] {
  return Array.from({ length: count }, (_, i) => read(at + i * step));
}

/** The number of axes, which is from 1 to 7, tells the order of bytes. */
function isBigEndian(littleCount: number, view: DataView): boolean {
  if (littleCount === 0) {
    return !(view.getInt32(0, true) in LENGTHS);
  }
  return littleCount < 1 || littleCount > 7;
}

/** The field of 80 letters at a byte, without zeros. */
function lettersOf(view: DataView, at: number): string {
  const bytes = new Uint8Array(view.buffer, view.byteOffset + at, 80);
  return new TextDecoder('latin1').decode(bytes).replaceAll('\0', '');
}

function firstHeader(view: DataView): Fields {
  const isBig = isBigEndian(view.getInt16(40, true), view);
  const short = (at: number) => view.getInt16(at, !isBig);
  const float = (at: number) => view.getFloat32(at, !isBig);
  return {
    isBig,
    dim: several(8, 2, 40, short),
    glmin: view.getInt32(144, !isBig),
    datatype: short(70),
    pixdim: several(8, 4, 76, float),
    voxOffset: float(108),
    slope: float(112),
    intercept: float(116),
    units: view.getUint8(123),
    qformCode: short(252),
    sformCode: short(254),
    quaternion: several(3, 4, 256, float),
    offset: several(3, 4, 268, float),
    rows: [280, 296, 312].map((at) => several(4, 4, at, float)),
    description: lettersOf(view, 148),
  };
}

function secondHeader(view: DataView): Fields {
  const isBig = isBigEndian(Number(view.getBigInt64(16, true)), view);
  const whole = (at: number) => view.getInt32(at, !isBig);
  const long = (at: number) => Number(view.getBigInt64(at, !isBig));
  const double = (at: number) => view.getFloat64(at, !isBig);
  return {
    isBig,
    dim: several(8, 8, 16, long),
    glmin: 0,
    datatype: view.getInt16(12, !isBig),
    pixdim: several(8, 8, 104, double),
    voxOffset: long(168),
    slope: double(176),
    intercept: double(184),
    units: whole(500),
    qformCode: whole(344),
    sformCode: whole(348),
    quaternion: several(3, 8, 352, double),
    offset: several(3, 8, 376, double),
    rows: [400, 432, 464].map((at) => several(4, 8, at, double)),
    description: lettersOf(view, 240),
  };
}
