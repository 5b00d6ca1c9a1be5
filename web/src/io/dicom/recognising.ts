/** Recognises a DICOM file by its first bytes, without the parser. */

export const PREAMBLE = 132;

/** Whether a file that starts with these bytes is DICOM, with a preamble or without. */
export function isDicom(head: Uint8Array): boolean {
  const isBare = (head[0] === 8 || head[0] === 2) && head[1] === 0 && head[3] === 0;
  return lettersAt(head, 128, 4) === 'DICM' || isBare;
}

export function lettersAt(bytes: Uint8Array, at: number, count: number): string {
  return String.fromCharCode(...bytes.subarray(at, at + count));
}
