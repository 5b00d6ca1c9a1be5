/** Converts DICOM elements to plain values for `lumencut-dicom`. */
import type { Element } from 'dicom-parser';
import type { Parsed } from './parsing';

export type Value = null | true | number | string | readonly (number | string)[];

const TEXTS = ['AE', 'AS', 'CS', 'DA', 'DS', 'DT', 'IS', 'LO', 'PN', 'SH', 'TM', 'UC', 'UI'];
const NUMBERS = {
  US: [2, 'getUint16'],
  SS: [2, 'getInt16'],
  UL: [4, 'getUint32'],
  SL: [4, 'getInt32'],
  FL: [4, 'getFloat32'],
  FD: [8, 'getFloat64'],
} as const;

/** The names that browsers use for DICOM character sets. Other sets are read as UTF-8. */
const CHARACTER_SETS: Readonly<Record<string, string>> = {
  'ISO_IR 100': 'latin1',
  'ISO_IR 101': 'iso-8859-2',
  'ISO_IR 109': 'iso-8859-3',
  'ISO_IR 110': 'iso-8859-4',
  'ISO_IR 144': 'iso-8859-5',
  'ISO_IR 127': 'iso-8859-6',
  'ISO_IR 126': 'iso-8859-7',
  'ISO_IR 138': 'iso-8859-8',
  'ISO_IR 148': 'iso-8859-9',
  'ISO_IR 203': 'iso-8859-15',
  'ISO_IR 13': 'shift_jis',
  'ISO_IR 166': 'windows-874',
  'ISO_IR 192': 'utf-8',
  'ISO 2022 IR 87': 'iso-2022-jp',
  'ISO 2022 IR 149': 'euc-kr',
  'ISO 2022 IR 58': 'gb18030',
  GB18030: 'gb18030',
  GBK: 'gbk',
};

export function bytesIn(file: Parsed, element: Element): Uint8Array {
  return file.bytes.subarray(element.dataOffset, element.dataOffset + element.length);
}

/** Text decoder of a file with these character sets; the last one that is known is used. */
export function decoderOf(sets: readonly string[]): TextDecoder {
  const known = sets.map((name) => CHARACTER_SETS[name]).filter((label) => label !== undefined);
  return new TextDecoder(known.at(-1) ?? 'utf-8');
}

/** The texts of an element with several values, which backslashes separate. */
export function textsOf(file: Parsed, element: Element, decoder = new TextDecoder()): string[] {
  const text = decoder.decode(bytesIn(file, element));
  return text.split('\\').map((one) => one.replace(/[\0 ]+$/, ''));
}

export function valueIn(file: Parsed, element: Element, vr: string, decoder: TextDecoder): Value {
  if (vr === 'SQ') {
    return element.items?.length ?? (element.length === 0 ? 0 : true);
  }
  if (element.length === 0) {
    return null;
  }
  if (TEXTS.includes(vr)) {
    const isNumber = vr === 'DS' || vr === 'IS';
    const texts = textsOf(file, element, decoder).map((text) => (isNumber ? text.trim() : text));
    return one(texts.length > 1 ? texts : texts.filter((text) => text !== ''));
  }
  return vr in NUMBERS ? numbers(file, element, vr as keyof typeof NUMBERS) : true;
}

function numbers(file: Parsed, element: Element, vr: keyof typeof NUMBERS): Value {
  const [unit, read] = NUMBERS[vr];
  const bytes = bytesIn(file, element);
  if (bytes.length % unit !== 0) {
    return true;
  }
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const found = Array.from({ length: bytes.length / unit }, (_, i) => view[read](i * unit, !file.isBig));
  return one(found.map((value) => (Number.isFinite(value) ? value : notFinite(value))));
}

/** The text for a number that JSON cannot represent. */
function notFinite(value: number): string {
  return Number.isNaN(value) ? 'nan' : value > 0 ? 'inf' : '-inf';
}

function one(values: readonly (number | string)[]): Value {
  return values.length > 1 ? values : (values[0] ?? null);
}
