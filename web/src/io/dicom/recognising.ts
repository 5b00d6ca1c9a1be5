/** DICOM by the first bytes of a file, without a parser. */

/** Where the file meta information begins, behind a preamble. */
export const PREAMBLE = 132;

/** Whether the first bytes of a file are those of DICOM: the preamble, or a bare identifying group. */
export function isDicom(head: Uint8Array): boolean {
  const isBare = (head[0] === 8 || head[0] === 2) && head[1] === 0 && head[3] === 0;
  return lettersAt(head, 128, 4) === 'DICM' || isBare;
}

/** Bytes as letters. */
export function lettersAt(bytes: Uint8Array, at: number, count: number): string {
  return String.fromCharCode(...bytes.subarray(at, at + count));
}
