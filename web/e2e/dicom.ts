/** Creates a synthetic DICOM series: slices of 16 × 16 voxels, 2 mm apart, with a bright rod. */

const SIDE = 16;
const CT = '1.2.840.10008.5.1.4.1.1.2';
const EXPLICIT = '1.2.840.10008.1.2.1';

function element(tag: number, vr: string, value: string | number): Buffer {
  const odd = typeof value === 'string' ? value.length % 2 : 0;
  const bytes =
    typeof value === 'number'
      ? Buffer.from(Uint16Array.of(value).buffer)
      : Buffer.from(value + (vr === 'UI' ? '\0' : ' ').repeat(odd), 'latin1');
  const head = Buffer.alloc(8);
  head.writeUInt16LE(tag >>> 16, 0);
  head.writeUInt16LE(tag & 0xffff, 2);
  head.write(vr, 4, 'latin1');
  head.writeUInt16LE(bytes.length, 6);
  return Buffer.concat([head, bytes]);
}

interface Of {
  readonly uid: string;
  readonly number: string;
  readonly patient?: string;
}
const ONE: Of = { uid: '1.2.3', number: '7' };

function pixels(phase: number): Buffer {
  const values = Int16Array.from({ length: SIDE * SIDE }, (_, n) => {
    const [column, row] = [n % SIDE, Math.floor(n / SIDE)];
    return Math.hypot(column - 8, row - 8) < 4 ? 300 + 100 * phase : -100;
  });
  const head = Buffer.alloc(12);
  head.writeUInt16LE(0x7fe0, 0);
  head.writeUInt16LE(0x0010, 2);
  head.write('OW', 4, 'latin1');
  head.writeUInt32LE(values.byteLength, 8);
  return Buffer.concat([head, Buffer.from(values.buffer)]);
}

/** One slice at a height (mm), in one of several phases. */
function slice(height: number, [phase, phases]: readonly [number, number], of: Of): Buffer {
  const uid = `${of.uid}.${height}.${phase}`;
  const meta = Buffer.concat([
    element(0x00020002, 'UI', CT),
    element(0x00020003, 'UI', uid),
    element(0x00020010, 'UI', EXPLICIT),
  ]);
  const length = Buffer.from([2, 0, 0, 0, 0x55, 0x4c, 4, 0, 0, 0, 0, 0]);
  length.writeUInt32LE(meta.length, 8);
  const trigger = phases > 1 ? [element(0x00181060, 'DS', String(400 * phase))] : [];
  return Buffer.concat([
    Buffer.alloc(128),
    Buffer.from('DICM'),
    length,
    meta,
    element(0x00080008, 'CS', 'ORIGINAL\\PRIMARY\\AXIAL'),
    element(0x00080016, 'UI', CT),
    element(0x00080018, 'UI', uid),
    element(0x00080060, 'CS', 'CT'),
    ...(of.patient ? [element(0x00100020, 'LO', of.patient)] : []),
    element(0x00180050, 'DS', '2'),
    ...trigger,
    element(0x0020000e, 'UI', of.uid),
    element(0x00200011, 'IS', of.number),
    element(0x00200032, 'DS', `0\\0\\${height}`),
    element(0x00200037, 'DS', '1\\0\\0\\0\\1\\0'),
    element(0x00280002, 'US', 1),
    element(0x00280004, 'CS', 'MONOCHROME2'),
    element(0x00280010, 'US', SIDE),
    element(0x00280011, 'US', SIDE),
    element(0x00280030, 'DS', '1\\1'),
    element(0x00280100, 'US', 16),
    element(0x00280101, 'US', 16),
    element(0x00280102, 'US', 15),
    element(0x00280103, 'US', 1),
    pixels(phase),
  ]);
}

/** Slices at these heights (mm) for each phase; phases differ by 100 in the rod. */
export function series(heights: readonly number[], phases = 1, of = ONE) {
  return Array.from({ length: phases }, (_, phase) =>
    heights.map((height) => ({
      name: `${of.number}-IM${phase}-${height}.dcm`,
      mimeType: 'application/dicom',
      buffer: slice(height, [phase, phases], of),
    })),
  ).flat();
}
