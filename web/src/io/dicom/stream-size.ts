/** Reads the image size from a compressed frame, to check it before a decoder allocates memory. */
import type { Bytes } from '../source';

export interface StreamSize {
  readonly columns: number;
  readonly rows: number;
  readonly components: number;
  readonly bits: number;
}

export function codestreamSize(frame: Bytes): StreamSize | null {
  const view = new DataView(frame.buffer, frame.byteOffset, frame.byteLength);
  for (let at = 0; at + 43 <= frame.length; at += 1) {
    if (view.getUint32(at) === 0xff4fff51) {
      const [right, bottom, left, top] = [8, 12, 16, 20].map((place) => view.getUint32(at + place));
      return {
        columns: (right ?? 0) - (left ?? 0),
        rows: (bottom ?? 0) - (top ?? 0),
        components: view.getUint16(at + 40),
        bits: (view.getUint8(at + 42) & 0x7f) + 1,
      };
    }
  }
  return null;
}

export function jpegSize(frame: Bytes): StreamSize | null {
  const view = new DataView(frame.buffer, frame.byteOffset, frame.byteLength);
  let at = 2;
  while (at + 10 <= frame.length) {
    const marker = view.getUint8(at + 1);
    if (view.getUint8(at) !== 0xff) {
      return null;
    }
    if (isFrameHeader(marker)) {
      return {
        bits: view.getUint8(at + 4),
        rows: view.getUint16(at + 5),
        columns: view.getUint16(at + 7),
        components: view.getUint8(at + 9),
      };
    }
    at += marker === 0xff ? 1 : 2 + view.getUint16(at + 2);
  }
  return null;
}

/** Whether a marker starts a frame header (SOF), including JPEG-LS; table markers lie in the same range. */
function isFrameHeader(marker: number): boolean {
  const isOfJpeg = marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker);
  return isOfJpeg || marker === 0xf7;
}
