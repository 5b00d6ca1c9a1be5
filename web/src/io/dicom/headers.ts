/** Reads the header of a DICOM file: the record for `lumencut-dicom`, and where and how the pixels are stored. */
import { Failure } from '../../core/failure';
import { fileName, type Source } from '../source';
import { damaged, printable } from '../words';
import { TAGS } from './attributes';
import { isDicom, type Parsed, type PixelElement, parsed } from './parsing';
import type { HeaderRecord, Recorder } from './records';
import { bytesIn, textsOf } from './values';

/** Bytes to read for the header: enough for most single-frame files, then for most multi-frame files. */
const HEADS = [1 << 17, 1 << 23];

/** A DICOM file whose pixels are not read yet. */
export interface Image {
  readonly source: Source;
  readonly header: HeaderRecord;
  readonly study: string;
  readonly pixels: PixelElement | null;
  readonly isBig: boolean;
  readonly isDeflated: boolean;
  /** Start and length of each frame, from the extended offset table. */
  readonly extended: readonly (readonly [number, number])[] | null;
}

export interface ExaminedFile {
  readonly source: Source;
  readonly image: Image | null;
  readonly record: { readonly name: string; readonly kind: string; readonly header?: HeaderRecord };
}

export async function examine(source: Source, recorder: Recorder): Promise<ExaminedFile> {
  const name = printable(fileName(source.path));
  const head = await source.slice(0, HEADS[0] ?? 0);
  if (!isDicom(head)) {
    return { source, image: null, record: { name, kind: otherKind(head) } };
  }
  const image = imageOf(source, await header(source, head), recorder);
  return { source, image, record: { name, kind: '', header: image.header } };
}

/** Position of the pixel data in a file, and whether the file is deflated. */
export async function pixelsOf(source: Source): Promise<Pick<Parsed, 'pixels' | 'isDeflated'>> {
  return header(source, await source.slice(0, HEADS[0] ?? 0));
}

/** Parses the header. Reads more of the file until the pixel data is found, or the file ends. */
async function header(source: Source, head: Uint8Array<ArrayBuffer>): Promise<Parsed> {
  for (const length of [...HEADS, source.size]) {
    const isWhole = length >= source.size;
    try {
      const found = parsed(source.path, length === HEADS[0] ? head : await source.slice(0, length));
      if (found.pixels || isWhole) {
        return found;
      }
    } catch (error) {
      if (isWhole || error instanceof Failure) {
        throw error instanceof Failure ? error : unreadable(source);
      }
    }
    if (isWhole) {
      break;
    }
  }
  throw unreadable(source);
}

function unreadable(source: Source): Failure {
  return damaged(source.path, 'a damaged or truncated header', 'an intact DICOM file');
}

function imageOf(source: Source, file: Parsed, recorder: Recorder): Image {
  try {
    const { pixels, isBig, isDeflated } = file;
    const study = file.elements[TAGS.study];
    return {
      source,
      header: recorder.record(file),
      study: study ? (textsOf(file, study)[0] ?? '') : '',
      pixels,
      isBig,
      isDeflated,
      extended: extendedTable(file),
    };
  } catch {
    throw unreadable(source);
  }
}

function extendedTable(file: Parsed): Image['extended'] {
  const [offsets, lengths] = ['x7fe00001', 'x7fe00002'].map((tag) => {
    const element = file.elements[tag];
    if (!element) {
      return [];
    }
    const bytes = bytesIn(file, element);
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const count = Math.floor(bytes.length / 8);
    return Array.from({ length: count }, (_, i) => Number(view.getBigUint64(8 * i, !file.isBig)));
  });
  return offsets?.length ? offsets.map((offset, i) => [offset, lengths?.[i] ?? 0] as const) : null;
}

/** Describes a file that is not DICOM. */
function otherKind(head: Uint8Array): string {
  const isZip = head[0] === 0x50 && head[1] === 0x4b && (head[2] === 3 || head[2] === 5);
  const packed = isZip ? 'zip archive' : head[0] === 0x1f && head[1] === 0x8b ? 'gzipped' : '';
  return packed ? `${packed}; unpack it first` : 'no DICOM';
}
