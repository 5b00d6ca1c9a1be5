/** The fields of an NRRD header that place and describe the voxels. */
import { isOfSegment } from './segments';
import { decoded, numberOf, wordsOf } from './text-header';
import { formatFailure } from './words';

const FIELDS = [
  ...['type', 'dimension', 'sizes', 'encoding', 'endian', 'kinds', 'data file', 'line skip', 'byte skip'],
  ...['space', 'space dimension', 'space directions', 'space origin', 'space units', 'spacings', 'axis mins'],
];
const FULL_NAMES = new Map(
  FIELDS.flatMap((name) => [[name, name] as const, [name.replaceAll(' ', ''), name] as const]),
);
/** The longest header that is read (bytes). */
export const LONGEST_HEADER = 1 << 20;
/** The longest field that is believed. */
const LONGEST_VALUE = 4096;

/** A vector of numbers, null for an axis that has none. */
export type Direction = readonly number[] | null;

export class NrrdHeader {
  constructor(
    readonly path: string,
    private readonly fields: ReadonlyMap<string, string>,
    /** The byte behind the header. */
    readonly end: number,
    /** What the file says that it holds. */
    readonly content: string,
    /** The lines that describe segments of 3D Slicer. */
    readonly segmentLines: readonly string[],
  ) {}

  has(name: string): boolean {
    return this.fields.has(name);
  }

  text(name: string): string {
    return this.fields.get(name) ?? '';
  }

  required(name: string): string {
    if (!this.fields.has(name)) {
      const expected = 'an NRRD header with type, dimension, sizes, encoding';
      throw formatFailure(this.path, `no field '${name}'`, expected);
    }
    return this.text(name);
  }

  whole(name: string): number[] {
    return this.numbers(name).map((value) => (Number.isInteger(value) ? value : this.refuse()));
  }

  numbers(name: string): number[] {
    return wordsOf(this.text(name)).map((word) => numberOf(word) ?? this.refuse());
  }

  /** The words of a field, each of which may be quoted. */
  words(name: string): string[] {
    return [...this.text(name).matchAll(/"([^"]*)"|(\S+)/g)].map((found) => found[1] ?? found[2] ?? '');
  }

  /** Vectors in parentheses; `none` and vectors of which no part is a number stand for no direction. */
  directions(name: string): Direction[] {
    const found = this.text(name).match(/\([^()]*\)|[^\s()]+/g) ?? [];
    return found.map((written) => {
      if (written.toLowerCase() === 'none') {
        return null;
      }
      const inside = /^\((.*)\)$/.exec(written)?.[1] ?? this.refuse();
      const values = inside.split(',').map((word) => numberOf(word.trim()) ?? this.refuse());
      return values.every(Number.isNaN) ? null : values;
    });
  }

  private refuse(): never {
    throw formatFailure(
      this.path,
      'a field of the header that cannot be read',
      'numbers as NRRD writes them',
    );
  }
}

/** Reads a header of the first bytes of a file. */
export function readHeader(path: string, head: Uint8Array): NrrdHeader {
  const { lines, end } = linesOf(path, head);
  const version = /^NRRD(\d+)$/.exec(lines[0] ?? '')?.[1];
  if (version === undefined || Number(version) > 5) {
    throw formatFailure(path, 'a newer or no NRRD version', 'NRRD0001 to NRRD0005');
  }
  const fields = new Map<string, string>();
  for (const line of lines.slice(1)) {
    const middle = line.indexOf(':');
    const name = FULL_NAMES.get(wordsOf(line.slice(0, Math.max(middle, 0)).toLowerCase()).join(' '));
    const value = line.slice(middle + 1);
    if (line.startsWith('#') || middle < 0 || value.startsWith('=') || name === undefined) {
      continue;
    }
    if (fields.has(name)) {
      throw formatFailure(path, `two fields '${name}'`, 'one', 'remove one of them');
    }
    if (value.length > LONGEST_VALUE) {
      throw formatFailure(path, `${value.length} letters in the field '${name}'`, `at most ${LONGEST_VALUE}`);
    }
    fields.set(name, value.trim());
  }
  const content = lines.find((line) => /^content\s*:[^=]/i.test(line)) ?? '';
  return new NrrdHeader(path, fields, end, content, lines.filter(isOfSegment));
}

/** The lines of a header, up to an empty line or the end of the file, and the byte behind them. */
function linesOf(path: string, head: Uint8Array): { lines: string[]; end: number } {
  const lines: string[] = [];
  let start = 0;
  while (start < head.length) {
    const found = head.indexOf(10, start);
    if (found < 0 && head.length === LONGEST_HEADER) {
      throw formatFailure(path, `a header of over ${LONGEST_HEADER} bytes`, 'an NRRD header');
    }
    const stop = found < 0 ? head.length : found;
    const line = decoded(head.subarray(start, stop)).trimEnd();
    start = stop + 1;
    if (line === '') {
      break;
    }
    lines.push(line);
  }
  return { lines, end: Math.min(start, head.length) };
}
