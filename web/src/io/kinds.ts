/** Identifies the format of a file by its content, or by its name if the content is ambiguous. */
import { isDicom } from './dicom/recognising';
import { firstBytes } from './inflating';
import { fileName, type Source } from './source';

export type Kind = 'nifti' | 'nrrd' | 'metaimage' | 'dicom' | 'zip' | 'centerlines' | 'empty' | 'other';

export interface Known {
  readonly source: Source;
  readonly kind: Kind;
  readonly words: string;
  readonly mend: string;
}

const HEAD = 4096;
const CONVERT = 'convert it to NIfTI, NRRD or MetaImage';
const LINES = ['.vtp', '.fcsv', '.pth', '.swc', '.tre', '.csv', '.mrk.json'];
const WORDS: Readonly<Record<string, string>> = {
  nifti: 'a NIfTI volume',
  nrrd: 'an NRRD volume',
  metaimage: 'a MetaImage volume',
  dicom: 'a DICOM image',
  zip: 'a zip archive',
  empty: 'an empty file',
};

export async function known(source: Source): Promise<Known> {
  if (source.size === 0) {
    return { source, kind: 'empty', words: WORDS.empty ?? '', mend: '' };
  }
  const head = await firstBytes(source, HEAD);
  const name = fileName(source.path).toLowerCase();
  const kind = ofBytes(head, name);
  if (kind !== null) {
    return { source, kind, words: WORDS[kind] ?? '', mend: '' };
  }
  return { source, ...(ofText(head) ?? ofName(name)) };
}

function ofBytes(head: Uint8Array, name: string): Kind | null {
  const letters = new TextDecoder('latin1').decode(head);
  if (letters.startsWith('PK\x03\x04') || letters.startsWith('PK\x05\x06')) {
    return 'zip';
  }
  if (letters.startsWith('NRRD')) {
    return 'nrrd';
  }
  if (isDicom(head)) {
    return 'dicom';
  }
  if (/\.(mha|mhd)$/.test(name) || /^ObjectType\s*=\s*Image/m.test(letters)) {
    return 'metaimage';
  }
  return isNifti(head) ? 'nifti' : null;
}

/** Whether the first number is the length of a NIfTI header, in either byte order. */
function isNifti(head: Uint8Array): boolean {
  const view = new DataView(head.buffer, head.byteOffset, head.byteLength);
  const lengths = head.length < 4 ? [] : [view.getInt32(0, true), view.getInt32(0, false)];
  return lengths.includes(348) || lengths.includes(540);
}

type FileKind = Omit<Known, 'source'>;

const NOTHING: FileKind = { kind: 'other', words: 'a file of unknown format', mend: '' };

function ofText(head: Uint8Array): FileKind | null {
  const text = new TextDecoder('latin1')
    .decode(head)
    .replace(/^\xef\xbb\xbf/, '')
    .trimStart();
  if (text.startsWith('{')) {
    return ofJson(text);
  }
  if (text.startsWith('<')) {
    return ofVtk(/<VTKFile[^>]*\stype\s*=\s*["'](\w+)/.exec(text)?.[1] ?? '');
  }
  return text.startsWith('# vtk DataFile')
    ? ofVtk(/^\s*DATASET\s+(\w+)/im.exec(text)?.[1]?.toUpperCase() ?? '')
    : null;
}

function ofVtk(kind: string): FileKind | null {
  if (kind === 'ImageData' || kind === 'STRUCTURED_POINTS') {
    return { kind: 'other', words: 'a VTK image, which is not read', mend: CONVERT };
  }
  const isLines = kind === 'PolyData' || kind === 'POLYDATA';
  return isLines ? { kind: 'centerlines', words: 'VTK PolyData', mend: '' } : null;
}

function ofJson(text: string): FileKind | null {
  const kind = /"vtkClass"\s*:\s*"(\w+)"/.exec(text)?.[1];
  if (kind === 'vtkImageData') {
    return { kind: 'other', words: 'an image in the JSON of vtk.js, which is not read', mend: CONVERT };
  }
  return kind || text.includes('"markups"')
    ? { kind: 'centerlines', words: '3D Slicer markups', mend: '' }
    : null;
}

function ofName(name: string): FileKind {
  const ending = LINES.find((one) => name.endsWith(one));
  if (ending) {
    return { kind: 'centerlines', words: `a ${ending} file`, mend: '' };
  }
  return /\.(nii|hdr)(\.gz)?$/.test(name) ? { kind: 'nifti', words: WORDS.nifti ?? '', mend: '' } : NOTHING;
}
