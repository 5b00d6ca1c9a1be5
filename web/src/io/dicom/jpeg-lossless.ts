/** Decodes lossless JPEG (ITU T.81, process 14) with one component, which the decoder packages do not support. */
import type { Bytes } from '../source';
import type { Decoded } from './decoded';
import { Bits, Codes, DamagedScan } from './jpeg-bits';

interface Scan {
  readonly columns: number;
  readonly rows: number;
  readonly precision: number;
  readonly codes: Codes;
  readonly predictor: number;
  readonly shift: number;
  /** Samples between restart markers; 0 without markers. */
  readonly interval: number;
  readonly start: number;
}

const [FRAME, HUFFMAN, START, RESTARTS] = [0xc3, 0xc4, 0xda, 0xdd];

export function decodeLossless(frame: Bytes): Decoded {
  const scan = readMarkers(frame);
  const { columns, rows, precision } = scan;
  const values = samples(scan, new Bits(frame, scan.start));
  const unit = precision > 8 ? 2 : 1;
  const bytes = unit === 2 ? new Uint8Array(values.buffer) : Uint8Array.from(values);
  return { columns, rows, components: 1, bytes, unit };
}

function readMarkers(frame: Bytes): Scan {
  const view = new DataView(frame.buffer, frame.byteOffset, frame.byteLength);
  const tables = new Map<number, Codes>();
  let [at, interval, size] = [2, 0, null as { columns: number; rows: number; precision: number } | null];
  for (;;) {
    const [marker, length] = [view.getUint8(at + 1), view.getUint16(at + 2)];
    if (view.getUint8(at) !== 0xff || length < 2) {
      throw new DamagedScan();
    }
    const segment = frame.subarray(at + 4, at + 2 + length);
    if (marker === HUFFMAN) {
      readTables(segment, tables);
    } else if (marker === RESTARTS) {
      interval = view.getUint16(at + 4);
    } else if (marker === FRAME) {
      size = {
        precision: view.getUint8(at + 4),
        rows: view.getUint16(at + 5),
        columns: view.getUint16(at + 7),
      };
    } else if (marker === START) {
      const codes = tables.get((segment[2] ?? 0) >> 4);
      if (!size || !codes || segment[0] !== 1 || size.precision < 2 || size.precision > 16) {
        throw new DamagedScan();
      }
      const [predictor, shift] = [segment[3] ?? 0, (segment[5] ?? 0) & 15];
      return { ...size, codes, predictor, shift, interval, start: at + 2 + length };
    }
    at += 2 + length;
  }
}

function readTables(segment: Bytes, tables: Map<number, Codes>): void {
  let at = 0;
  while (at + 17 <= segment.length) {
    const counts = segment.subarray(at + 1, at + 17);
    const total = counts.reduce((sum, count) => sum + count, 0);
    tables.set((segment[at] ?? 0) & 15, new Codes(counts, segment.subarray(at + 17, at + 17 + total)));
    at += 17 + total;
  }
}

function samples(scan: Scan, bits: Bits): Uint16Array<ArrayBuffer> {
  const { columns, rows, interval, shift } = scan;
  const values = new Uint16Array(columns * rows);
  let first = 0;
  for (let at = 0; at < values.length; at += 1) {
    if (interval > 0 && at > 0 && at % interval === 0) {
      bits.restart();
      first = at;
    }
    values[at] = predicted(scan, values, at, first) + difference(scan.codes, bits);
  }
  return shift > 0 ? values.map((value) => value << shift) : values;
}

/** Predicts a sample from its neighbours; the first line after a restart marker has no line above. */
function predicted(
  { columns, precision, shift, predictor }: Scan,
  values: Uint16Array,
  at: number,
  first: number,
): number {
  if (at === first) {
    return 1 << (precision - shift - 1);
  }
  const left = values[at - 1] ?? 0;
  if (at < first + columns) {
    return left;
  }
  const above = values[at - columns] ?? 0;
  if (at % columns === 0) {
    return above;
  }
  return mixed(predictor, left, above, values[at - columns - 1] ?? 0);
}

function mixed(predictor: number, left: number, above: number, corner: number): number {
  switch (predictor) {
    case 1:
      return left;
    case 2:
      return above;
    case 3:
      return corner;
    case 4:
      return left + above - corner;
    case 5:
      return left + ((above - corner) >> 1);
    case 6:
      return above + ((left - corner) >> 1);
    case 7:
      return (left + above) >> 1;
    default:
      throw new DamagedScan();
  }
}

function difference(codes: Codes, bits: Bits): number {
  const size = codes.read(bits);
  if (size === 0 || size >= 16) {
    return size === 0 ? 0 : 1 << 15;
  }
  const value = bits.take(size);
  return value < 1 << (size - 1) ? value - (1 << size) + 1 : value;
}
