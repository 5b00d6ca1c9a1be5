/** The words of refusals: the same as those of the Python package, for the same faults. */
import { Failure, type More } from '../core/failure';

const LONGEST_VALUE = 60;
const COPY_AGAIN = 'copy the file again';

/** A file that is damaged or holds something else than its reader expects. */
export function formatFailure(
  subject: string,
  found: string,
  expected: string,
  advice = '',
  more: More = {},
): Failure {
  return new Failure('format', subject, found, expected, advice, more);
}

/** The same where a new copy of the file may be whole. */
export function damaged(subject: string, found: string, expected: string): Failure {
  return formatFailure(subject, found, expected, COPY_AGAIN);
}

/** A text with nothing in it that breaks a line or cannot be seen. */
export function printable(text: string): string {
  return text.replace(/[\p{C}\p{Zl}\p{Zp}]|(?! )\p{Zs}/gu, '\ufffd');
}

/** A value of a header's field that is no free text, as one short printable line. */
export function shown(value: unknown): string {
  const text = printable(String(value));
  return text.length <= LONGEST_VALUE ? text.trim() : `${text.slice(0, LONGEST_VALUE - 1)}…`;
}

/** Numbers as a list in brackets. */
export function listed(values: readonly (number | bigint)[]): string {
  return `[${values.join(', ')}]`;
}

/** A number as short as it is exact to 6 digits. */
export function short(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(6))) : String(value).toLowerCase();
}
