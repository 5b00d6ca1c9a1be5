/** Texts of errors about files, identical to those of the Python package. */
import { Failure, type More } from '../core/failure';

const LONGEST_VALUE = 60;
const COPY_AGAIN = 'copy the file again';

export function formatFailure(
  subject: string,
  found: string,
  expected: string,
  advice = '',
  more: More = {},
): Failure {
  return new Failure('format', subject, found, expected, advice, more);
}

/** An error about a damaged file; it advises to copy the file again. */
export function damaged(subject: string, found: string, expected: string): Failure {
  return formatFailure(subject, found, expected, COPY_AGAIN);
}

export function printable(text: string): string {
  return text.replace(/[\p{C}\p{Zl}\p{Zp}]|(?! )\p{Zs}/gu, '\ufffd');
}

export function shown(value: unknown): string {
  const text = printable(String(value));
  return text.length <= LONGEST_VALUE ? text.trim() : `${text.slice(0, LONGEST_VALUE - 1)}…`;
}

export function listed(values: readonly (number | bigint)[]): string {
  return `[${values.join(', ')}]`;
}

/** A number with at most 6 significant digits, in its shortest form. */
export function short(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(6))) : String(value).toLowerCase();
}
