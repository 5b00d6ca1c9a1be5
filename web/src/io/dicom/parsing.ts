/** Parses a DICOM file up to its pixel data, with the package dicom-parser. */
import dicomParser, { type ByteStream, type Element } from 'dicom-parser';
import { Part } from '../inflating';
import type { Bytes } from '../source';
import { formatFailure } from '../words';
import { TAGS } from './attributes';

export const SYNTAXES = {
  implicit: '1.2.840.10008.1.2',
  explicit: '1.2.840.10008.1.2.1',
  deflated: '1.2.840.10008.1.2.1.99',
  big: '1.2.840.10008.1.2.2',
} as const;

export interface PixelElement {
  readonly keyword: 'PixelData' | 'FloatPixelData' | 'DoubleFloatPixelData';
  readonly vr: string;
  /** Offset of the pixel value in the file, or in the inflated bytes of a deflated file. */
  readonly at: number;
}

export interface Parsed {
  readonly syntax: string;
  readonly bytes: Bytes;
  readonly isBig: boolean;
  /** Whether the file is deflated; then `bytes` are inflated. */
  readonly isDeflated: boolean;
  readonly elements: Elements;
  readonly meta: Elements;
  readonly pixels: PixelElement | null;
}

type Elements = Readonly<Record<string, Element>>;

const PIXELS: Readonly<Record<string, PixelElement['keyword']>> = {
  '7fe00010': 'PixelData',
  '7fe00008': 'FloatPixelData',
  '7fe00009': 'DoubleFloatPixelData',
};
const DEFLATE_FLOOR = 64 << 20;
const DEFLATE_RATIO = 20;
const PIECE = 1 << 20;

/** Parses a file or its beginning; throws if the bytes end before the pixel data. */
export function parsed(path: string, given: Bytes): Parsed {
  const { meta, start, syntax } = metaOf(given);
  const isDeflated = syntax === SYNTAXES.deflated;
  const bytes = isDeflated ? inflatedFrom(path, given, start) : given;
  const isBig = syntax === SYNTAXES.big;
  const order = isBig ? dicomParser.bigEndianByteArrayParser : dicomParser.littleEndianByteArrayParser;
  const stream = new dicomParser.ByteStream(order, bytes, isDeflated ? 0 : start);
  const { elements, pixels } = elementsOf(stream, syntax === SYNTAXES.implicit);
  return { syntax, bytes, isBig, isDeflated, meta, elements, pixels };
}

/** File meta information. If a file has none, the encoding is derived from its first element. */
function metaOf(given: Bytes): { meta: Elements; start: number; syntax: string } {
  const hasPreamble = lettersAt(given, 128, 4) === 'DICM';
  const order = dicomParser.littleEndianByteArrayParser;
  const stream = new dicomParser.ByteStream(order, given, hasPreamble ? PREAMBLE : 0);
  const meta: Record<string, Element> = {};
  while (nextElement(stream, false).tag.startsWith('0002')) {
    const element = dicomParser.readDicomElementExplicit(stream, []);
    meta[element.tag] = element;
  }
  const start = stream.position;
  const stated = meta[TAGS.transferSyntax];
  const named = stated ? lettersAt(given, stated.dataOffset, stated.length).replace(/[\0 ]+$/, '') : '';
  const isExplicit = /^[A-Z]{2}$/.test(lettersAt(given, start + 4, 2));
  return { meta, start, syntax: named || (isExplicit ? SYNTAXES.explicit : SYNTAXES.implicit) };
}

interface Found {
  readonly elements: Record<string, Element>;
  readonly pixels: PixelElement | null;
}

function elementsOf(stream: ByteStream, isImplicit: boolean): Found {
  const elements: Record<string, Element> = {};
  while (stream.position + 8 <= stream.byteArray.length) {
    const head = nextElement(stream, isImplicit);
    const keyword = PIXELS[head.tag];
    if (keyword) {
      return { elements, pixels: { keyword, vr: head.vr || 'OW', at: head.at } };
    }
    if (head.isUnknownToTheParser) {
      stream.seek(head.at - stream.position + head.length);
      elements[`x${head.tag}`] = {
        tag: `x${head.tag}`,
        vr: head.vr,
        length: head.length,
        dataOffset: head.at,
      };
      continue;
    }
    const element = isImplicit
      ? dicomParser.readDicomElementImplicit(stream)
      : dicomParser.readDicomElementExplicit(stream, []);
    elements[element.tag] = element;
  }
  return { elements, pixels: null };
}

interface Head {
  readonly tag: string;
  readonly vr: string;
  /** Offset of the value, assuming a four-byte length field. */
  readonly at: number;
  readonly length: number;
  readonly isUnknownToTheParser: boolean;
}

/** Reads the head of the next element without moving; dicom-parser does not know the 64-bit integer types. */
function nextElement(stream: ByteStream, isImplicit: boolean): Head {
  const start = stream.position;
  const number = (at: number, count: 2 | 4) => {
    const read = count === 2 ? stream.byteArrayParser.readUint16 : stream.byteArrayParser.readUint32;
    return at + count <= stream.byteArray.length ? read(stream.byteArray as Uint8Array, at) : 0;
  };
  const tag = [number(start, 2), number(start + 2, 2)]
    .map((part) => part.toString(16).padStart(4, '0'))
    .join('');
  if (isImplicit) {
    return { tag, vr: '', at: start + 8, length: number(start + 4, 4), isUnknownToTheParser: false };
  }
  const vr = lettersAt(stream.byteArray, start + 4, 2);
  const isUnknownToTheParser = vr === 'OV' || vr === 'SV' || vr === 'UV';
  return { tag, vr, at: start + 12, length: number(start + 8, 4), isUnknownToTheParser };
}

/** Inflates a deflated dataset; throws beyond a size that real scans do not reach. */
function inflatedFrom(path: string, bytes: Bytes, start: number): Bytes {
  const limit = Math.max(DEFLATE_FLOOR, DEFLATE_RATIO * bytes.length);
  const part = new Part('bare', path);
  part.give(bytes.subarray(start));
  const pieces: Bytes[] = [];
  let length = 0;
  while (!part.hasEnded) {
    const piece = part.take(PIECE);
    length += piece.length;
    if (length > limit) {
      const found = `${bytes.length} bytes that unpack to more than ${limit}`;
      throw formatFailure(path, found, `at most ${DEFLATE_RATIO} times the file`);
    }
    if (piece.length === 0 && part.isHungry) {
      break;
    }
    pieces.push(piece);
  }
  const whole = new Uint8Array(length);
  let at = 0;
  for (const piece of pieces) {
    whole.set(piece, at);
    at += piece.length;
  }
  return whole;
}

const PREAMBLE = 132;

/** Whether a file that starts with these bytes is DICOM, with a preamble or without. */
export function isDicom(head: Uint8Array): boolean {
  const isBare = (head[0] === 8 || head[0] === 2) && head[1] === 0 && head[3] === 0;
  return lettersAt(head, 128, 4) === 'DICM' || isBare;
}

function lettersAt(bytes: Uint8Array, at: number, count: number): string {
  return String.fromCharCode(...bytes.subarray(at, at + count));
}
