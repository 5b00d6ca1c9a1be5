/** Creates small test files, and damages them. */
import { deflateRawSync, gzipSync } from 'node:zlib';
import { BlobSource, type Source } from '../src/io/source';

export function file(path: string, bytes: Uint8Array | string): Source {
  return new BlobSource(path, new Blob([bytes as Uint8Array<ArrayBuffer>]));
}

/** A NIfTI-1 file of 16-bit numbers that count from 0; its header states the size `stated`. */
export function nifti(size: readonly [number, number, number] = [7, 5, 3], stated = size): Buffer {
  const header = Buffer.from(new ArrayBuffer(352));
  header.writeInt32LE(348, 0);
  new Int16Array(header.buffer, header.byteOffset + 40, 8).set([3, ...stated, 1, 1, 1, 1]);
  header.writeInt16LE(4, 70);
  header.writeInt16LE(16, 72);
  new Float32Array(header.buffer, header.byteOffset + 76, 4).set([1, 2, 3, 4]);
  header.writeFloatLE(352, 108);
  header.writeUInt8(2, 123);
  header.writeInt16LE(1, 254);
  new Float32Array(header.buffer, header.byteOffset + 280, 12).set([2, 0, 0, 5, 0, 3, 0.5, 6, 0, 0, 4, 7]);
  header.write('n+1\0', 344, 'latin1');
  const voxels = Int16Array.from({ length: size[0] * size[1] * size[2] }, (_, i) => i);
  return Buffer.concat([header, Buffer.from(voxels.buffer)]);
}

export function gzipped(bytes: Uint8Array): Buffer {
  return gzipSync(bytes);
}

export function changed(bytes: Uint8Array, at: number): Buffer {
  const copy = Buffer.from(bytes);
  copy[at] = (copy[at] ?? 0) ^ 0xff;
  return copy;
}

export function archived(name: string, bytes: Uint8Array, claimed = bytes.length): Buffer {
  const packed = deflateRawSync(bytes);
  const fields = Buffer.alloc(26);
  fields.writeUInt16LE(20, 0);
  fields.writeUInt16LE(8, 4);
  fields.writeUInt32LE(crc32(bytes), 10);
  fields.writeUInt32LE(packed.length, 14);
  fields.writeUInt32LE(claimed, 18);
  fields.writeUInt16LE(name.length, 22);
  const local = Buffer.concat([Buffer.from('PK\x03\x04'), fields, Buffer.from(name), packed]);
  const central = Buffer.concat([
    Buffer.from('PK\x01\x02\x14\0'),
    fields,
    Buffer.alloc(14),
    Buffer.from(name),
  ]);
  const end = Buffer.alloc(22);
  end.write('PK\x05\x06', 0, 'latin1');
  end.writeUInt16LE(1, 8);
  end.writeUInt16LE(1, 10);
  end.writeUInt32LE(central.length, 12);
  end.writeUInt32LE(local.length, 16);
  return Buffer.concat([local, central, end]);
}

function crc32(bytes: Uint8Array): number {
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; bit += 1) {
      sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
    }
  }
  return ~sum >>> 0;
}

/** A DICOM slice of 16-bit numbers; the file has no preamble. */
export function slice(changes: Readonly<Record<string, string | number>> = {}, z = 0): Buffer {
  const stated: Record<string, readonly [string, string | number]> = {
    '00080016': ['UI', '1.2.840.10008.5.1.4.1.1.2'],
    '00080018': ['UI', `1.2.3.${1000 + z}`],
    '00080060': ['CS', 'CT'],
    '00180050': ['DS', '2'],
    '0020000e': ['UI', '1.2.3.4'],
    '00200011': ['IS', '3'],
    '00200032': ['DS', `0\\0\\${2 * z}`],
    '00200037': ['DS', '1\\0\\0\\0\\1\\0'],
    '00280002': ['US', 1],
    '00280004': ['CS', 'MONOCHROME2'],
    '00280010': ['US', 3],
    '00280011': ['US', 4],
    '00280030': ['DS', '0.5\\0.75'],
    '00280100': ['US', 16],
    '00280101': ['US', 16],
    '00280102': ['US', 15],
    '00280103': ['US', 0],
  };
  for (const [tag, value] of Object.entries(changes)) {
    stated[tag] = [stated[tag]?.[0] ?? 'DS', value];
  }
  const tags = Object.keys(stated).sort();
  const pixels = Buffer.from(Uint16Array.from({ length: 12 }, (_, i) => 100 * z + i).buffer);
  const elements = tags.map((tag) => element(tag, ...(stated[tag] ?? ['', ''])));
  return Buffer.concat([...elements, Buffer.from('e07f10004f570000', 'hex'), long(pixels.length), pixels]);
}

function element(tag: string, vr: string, value: string | number): Buffer {
  const text = String(value);
  const short = Buffer.alloc(2);
  short.writeUInt16LE(vr === 'US' ? Number(value) : 0);
  const bytes = vr === 'US' ? short : Buffer.from(text.length % 2 ? `${text} ` : text);
  const head = Buffer.alloc(8);
  head.writeUInt16LE(Number.parseInt(tag.slice(0, 4), 16), 0);
  head.writeUInt16LE(Number.parseInt(tag.slice(4), 16), 2);
  head.write(vr, 4, 'latin1');
  head.writeUInt16LE(bytes.length, 6);
  return Buffer.concat([head, bytes]);
}

function long(value: number): Buffer {
  const bytes = Buffer.alloc(4);
  bytes.writeUInt32LE(value);
  return bytes;
}
