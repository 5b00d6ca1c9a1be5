/** Texts of errors about files, identical to those of the Python package. */
import { Failure, type More } from '../core/failure';

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
