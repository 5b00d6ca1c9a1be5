/** The stored bytes of each frame of a DICOM image. */

import type { Failure } from '../../core/failure';
import type { Bytes, Source } from '../source';
import { damaged, formatFailure } from '../words';
import type { Image } from './headers';
import { parsed, SYNTAXES } from './parsing';

/** Transfer syntaxes with uncompressed pixels, including the one that deflates the whole dataset. */
export const NATIVE: readonly string[] = Object.values(SYNTAXES);

const ITEM = 0xe000;
const GROUP = 0xfffe;
const END = 0xe0dd;
/** Bytes of the first read; the size doubles until all items are read. */
const FIRST_WINDOW = 1 << 20;

export interface Shape {
  readonly rows: number;
  readonly columns: number;
  readonly bitsAllocated: number;
  readonly bitsStored: number;
  readonly isSigned: boolean;
  readonly frameCount: number;
}

/** Size and sample type stated by the header, which `lumencut-dicom` has checked. */
export function shapeOf({ header }: Image): Shape {
  const number = (keyword: string, otherwise: number) => {
    const value = header.attributes[keyword];
    return value === undefined || value === null || value === true ? otherwise : Number(value);
  };
  const bitsAllocated = number('BitsAllocated', 16);
  return {
    rows: number('Rows', 0),
    columns: number('Columns', 0),
    bitsAllocated,
    bitsStored: number('BitsStored', bitsAllocated),
    isSigned: number('PixelRepresentation', 0) === 1,
    frameCount: number('NumberOfFrames', 1) || 1,
  };
}

export function frameBytes({ rows, columns, bitsAllocated }: Shape): number {
  return (rows * columns * bitsAllocated) / 8;
}

export class Frames {
  private readonly shape: Shape;
  private content: Bytes | null = null;
  private fragments: Bytes[] | null = null;

  constructor(readonly image: Image) {
    this.shape = shapeOf(image);
    if (!image.pixels) {
      throw damaged(image.source.path, 'no pixels', 'an image with pixels');
    }
  }

  frame(number: number): Promise<Bytes> {
    return NATIVE.includes(this.image.header.transfer_syntax) ? this.native(number) : this.compressed(number);
  }

  tooShort(held: number): Failure {
    const { frameCount, columns, rows } = this.shape;
    const frames = frameCount > 1 ? `${frameCount} × ` : '';
    const expected = `${frames}${columns} × ${rows} pixels as the header says`;
    return damaged(this.image.source.path, `${held} bytes of pixels`, expected);
  }

  private async native(number: number): Promise<Bytes> {
    const { source, isDeflated } = this.image;
    const at = this.image.pixels?.at ?? 0;
    const length = frameBytes(this.shape);
    const inflated = isDeflated ? await this.inflated() : null;
    const held = (inflated?.length ?? source.size) - at;
    if (held < length * this.shape.frameCount) {
      throw this.tooShort(held);
    }
    const start = at + number * length;
    return inflated ? inflated.slice(start, start + length) : source.slice(start, start + length);
  }

  private async inflated(): Promise<Bytes> {
    const { source } = this.image;
    this.content ??= parsed(source.path, await source.slice(0, source.size)).bytes;
    return this.content;
  }

  private async compressed(number: number): Promise<Bytes> {
    this.fragments ??= await this.everyFrame();
    const frame = this.fragments[number];
    if (!frame) {
      const expected = `${this.shape.frameCount} frames as the header says`;
      throw damaged(this.image.source.path, `${this.fragments.length} frames`, expected);
    }
    return frame;
  }

  private async everyFrame(): Promise<Bytes[]> {
    const { source, pixels, extended } = this.image;
    const bytes = await itemBytes(source, pixels?.at ?? 0);
    const { table, items, start } = itemsIn(source.path, bytes);
    if (extended) {
      return extended.map(([offset, length]) =>
        bytes.subarray(start + offset + 8, start + offset + 8 + length),
      );
    }
    const { frameCount } = this.shape;
    if (frameCount === 1) {
      return [joinedItems(items)];
    }
    if (table.length > 0) {
      const ends = [...table.slice(1), Number.POSITIVE_INFINITY];
      const between = (i: number) => (item: Item) =>
        item.offset >= (table[i] ?? 0) && item.offset < (ends[i] ?? 0);
      return table.map((_, i) => joinedItems(items.filter(between(i))));
    }
    if (items.length === frameCount) {
      return items.map((item) => item.bytes);
    }
    return byEndMarkers(items);
  }
}

interface Item {
  /** Bytes from the first item after the offset table. */
  readonly offset: number;
  readonly bytes: Bytes;
}

async function itemBytes(source: Source, start: number): Promise<Bytes> {
  for (let window = FIRST_WINDOW; ; window *= 2) {
    const bytes = await source.slice(start, Math.min(start + window, source.size));
    const end = endOfItems(bytes);
    if (end !== null || start + window >= source.size) {
      return bytes.subarray(0, end ?? bytes.length);
    }
  }
}

/** Position after the last item and its delimiter; null if the bytes end earlier. */
function endOfItems(bytes: Bytes): number | null {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 0;
  while (at + 8 <= bytes.length) {
    const isItem = view.getUint16(at, true) === GROUP && view.getUint16(at + 2, true) === ITEM;
    if (!isItem) {
      return at + 8;
    }
    at += 8 + view.getUint32(at + 4, true);
  }
  return null;
}

/** Splits encapsulated pixel data into the basic offset table and the fragments. */
function itemsIn(path: string, bytes: Bytes): { table: number[]; items: Item[]; start: number } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let [at, start, table] = [0, -1, [] as number[]];
  const items: Item[] = [];
  while (
    at + 8 <= bytes.length &&
    view.getUint16(at, true) === GROUP &&
    view.getUint16(at + 2, true) !== END
  ) {
    const length = view.getUint32(at + 4, true);
    if (view.getUint16(at + 2, true) !== ITEM || at + 8 + length > bytes.length) {
      throw damaged(path, 'truncated compressed pixels', 'complete pixels');
    }
    const content = bytes.subarray(at + 8, at + 8 + length);
    if (start < 0) {
      table = Array.from({ length: Math.floor(length / 4) }, (_, i) => view.getUint32(at + 8 + 4 * i, true));
      start = at + 8 + length;
    } else {
      items.push({ offset: at - start, bytes: content });
    }
    at += 8 + length;
  }
  if (items.length === 0) {
    throw formatFailure(path, 'no compressed pixels', 'an image with pixels', 'copy the file again');
  }
  return { table, items, start };
}

function joinedItems(items: readonly Item[]): Bytes {
  const [first] = items;
  if (items.length === 1 && first) {
    return first.bytes;
  }
  const whole = new Uint8Array(items.reduce((sum, item) => sum + item.bytes.length, 0));
  let at = 0;
  for (const item of items) {
    whole.set(item.bytes, at);
    at += item.bytes.length;
  }
  return whole;
}

function byEndMarkers(items: readonly Item[]): Bytes[] {
  const frames: Bytes[] = [];
  let begun: Item[] = [];
  for (const item of items) {
    begun.push(item);
    const tail = item.bytes.subarray(-10);
    if (tail.some((byte, i) => byte === 0xff && tail[i + 1] === 0xd9)) {
      frames.push(joinedItems(begun));
      begun = [];
    }
  }
  return begun.length > 0 ? [...frames, joinedItems(begun)] : frames;
}
