/** Parts shared by readers of text headers. */
import { Failure } from '../core/failure';
import { type Beside, besidePath, type Source } from './source';
import { formatFailure, shown } from './words';

/** A line of a header as UTF-8, or as Latin-1 if it is invalid, since file names may use either. */
export function decoded(line: Uint8Array): string {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(line);
  } catch {
    return new TextDecoder('latin1').decode(line);
  }
}

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const ODD_NUMBERS: Readonly<Record<string, number>> = {
  nan: Number.NaN,
  inf: Number.POSITIVE_INFINITY,
  '+inf': Number.POSITIVE_INFINITY,
  '-inf': Number.NEGATIVE_INFINITY,
};

/** The number that a word stands for, null where it is no number. */
export function numberOf(word: string): number | null {
  return NUMBER.test(word) ? Number(word) : (ODD_NUMBERS[word.toLowerCase()] ?? null);
}

/** The words of a text. */
export function wordsOf(text: string): string[] {
  return text.split(/\s+/).filter((word) => word !== '');
}

/** The file that a header names, which must lie in the header's folder or a folder below it. */
export async function dataFile(header: Source, name: string, field: string, beside: Beside): Promise<Source> {
  const parts = name.split(/[\\/]+/).filter((part) => part !== '.' && part !== '');
  if (parts.length === 0 || name !== shownWhole(name)) {
    throw formatFailure(header.path, `no file name in ${field}`, 'the name of a file next to the header');
  }
  if (/^([\\/~]|[a-z]:)/i.test(name) || parts.includes('..')) {
    const found = `${field}: a path that leaves the folder (${shown(name)})`;
    const expected = 'a file in the folder of the header or below';
    throw formatFailure(header.path, found, expected, 'copy it there and name it without a path');
  }
  const found = await beside(besidePath(header.path, parts.join('/')));
  if (!found) {
    const expected = `the header and its voxels, ${shown(parts.join('/'))}`;
    throw new Failure('file', header.path, 'a header alone', expected, 'choose both files together');
  }
  return found;
}

function shownWhole(name: string): string {
  return name.replace(/\p{C}/gu, '');
}
