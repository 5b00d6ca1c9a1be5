/** Decodes DICOM RLE (PS3.5 annex G): run-length coding of each byte plane. */
import type { Bytes } from '../source';

const HEADER = 64;

/** Decodes `count` values of `unit` bytes into native byte order; null if the frame is damaged. */
export function unpackRle(frame: Bytes, count: number, unit: number): Bytes | null {
  if (frame.length < HEADER) {
    return null;
  }
  const view = new DataView(frame.buffer, frame.byteOffset, frame.byteLength);
  if (view.getUint32(0, true) !== unit) {
    return null;
  }
  const pixels = new Uint8Array(count * unit);
  for (let segment = 0; segment < unit; segment += 1) {
    const start = view.getUint32(4 + 4 * segment, true);
    const next = segment + 1 < unit ? view.getUint32(8 + 4 * segment, true) : frame.length;
    if (start < HEADER || next > frame.length || start > next) {
      return null;
    }
    const found = unpackSegment(frame.subarray(start, next), pixels, unit - 1 - segment, unit);
    if (found < count) {
      return null;
    }
  }
  return pixels;
}

/** Decodes one segment into every `step`th byte from `first` on; returns how many bytes were written. */
function unpackSegment(packed: Bytes, pixels: Bytes, first: number, step: number): number {
  const count = pixels.length / step;
  let [at, found] = [0, 0];
  while (at < packed.length && found < count) {
    const control = packed[at] ?? 0;
    at += 1;
    if (control === 128) {
      continue;
    }
    const isRun = control > 128;
    const length = Math.min(isRun ? 257 - control : control + 1, count - found);
    for (let i = 0; i < length; i += 1) {
      pixels[first + step * (found + i)] = packed[isRun ? at : at + i] ?? 0;
    }
    if (at + (isRun ? 1 : length) > packed.length) {
      return found;
    }
    at += isRun ? 1 : length;
    found += length;
  }
  return found;
}
