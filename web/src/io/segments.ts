/** Reads the segments of a `.seg.nrrd` file of 3D Slicer, and converts them to a label map. */
import { ARRAYS, bytesOf, type Kind, numbersOf, type StoredKind } from './numbers';
import type { Bytes } from './payload';
import { formatFailure, printable } from './words';

/** A segment: its label number and name, and the layer and the value that mark its voxels. */
export interface Segment {
  readonly number: number;
  readonly name: string;
  readonly layer: number;
  readonly value: number;
}

/** Names of the labels of a volume, and how its layers are merged into one label map. */
export interface Labels {
  readonly names: Readonly<Record<number, string>>;
  readonly layers: number;
  /** Null if the stored values already are label numbers. */
  readonly map: LabelMap | null;
}

const FIELD = /^Segment(\d{1,6})_(ID|Name|LabelValue|Layer):=(.*)$/;
const LARGEST_NUMBER = 65535;

export const isOfSegment = (line: string): boolean => FIELD.test(line);

/** The segments of a header. If two share a label number, all segments are renumbered from 1. */
export function segmentsOf(lines: readonly string[], layers: number): Segment[] {
  const stated = new Map<number, Map<string, string>>();
  for (const line of lines) {
    const [, number, field, value] = FIELD.exec(line) ?? [];
    const fields = stated.get(Number(number)) ?? new Map();
    stated.set(Number(number), fields.set(field, (value ?? '').trim()));
  }
  const whole = (text: string | undefined, otherwise: number) =>
    text !== undefined && /^\d{1,9}$/.test(text) ? Number(text) : otherwise;
  const segments = [...stated.keys()]
    .sort((one, other) => one - other)
    .map((key, place) => {
      const fields = stated.get(key);
      const value = whole(fields?.get('LabelValue'), 1);
      const layer = whole(fields?.get('Layer'), layers > 1 ? place : 0);
      return { number: value, name: printable(fields?.get('Name') || `segment ${place + 1}`), layer, value };
    });
  const isUnique = new Set(segments.map((one) => one.number)).size === segments.length;
  return isUnique ? segments : segments.map((one, place) => ({ ...one, number: place + 1 }));
}

export function labelsOf(
  path: string,
  stored: StoredKind,
  segments: readonly Segment[],
  layers: number,
): Labels {
  for (const { number, name, layer } of segments) {
    if (layer >= layers) {
      const found = `segment ${number} ${name} in layer ${layer} of ${layers}`;
      throw formatFailure(path, found, 'a layer of the file', 'save the segmentation again');
    }
    if (number < 1 || number > LARGEST_NUMBER) {
      const found = `segment ${name} with the label ${number}`;
      throw formatFailure(path, found, `labels from 1 to ${LARGEST_NUMBER}`, 'save it again');
    }
  }
  const names = Object.fromEntries(segments.map(({ number, name }) => [number, name]));
  const isAsStored = layers === 1 && segments.every(({ number, value }) => number === value);
  return { names, layers, map: isAsStored ? null : new LabelMap(path, stored, segments, layers) };
}

export class LabelMap {
  readonly kind: Kind;
  private readonly overlaps = new Map<string, number>();

  constructor(
    private readonly path: string,
    private readonly stored: StoredKind,
    private readonly segments: readonly Segment[],
    private readonly layers: number,
  ) {
    this.kind = Math.max(0, ...segments.map((one) => one.number)) > 255 ? 'uint16' : 'uint8';
  }

  convert(bytes: Bytes): Bytes {
    const values = numbersOf(this.stored, bytes);
    const labels = new ARRAYS[this.kind as 'uint16'](values.length / this.layers);
    for (const segment of this.segments) {
      for (let voxel = 0, at = segment.layer; voxel < labels.length; voxel += 1, at += this.layers) {
        if (Number(values[at]) === segment.value) {
          this.put(labels, voxel, segment.number);
        }
      }
    }
    return bytesOf(labels);
  }

  private put(labels: Uint16Array, voxel: number, number: number): void {
    const other = labels[voxel];
    if (other) {
      const pair = `${other} ${number}`;
      this.overlaps.set(pair, (this.overlaps.get(pair) ?? 0) + 1);
    }
    labels[voxel] = number;
  }

  /** Throws if segments overlap, because a label map holds only one number per voxel. */
  refuseOverlaps(): void {
    const [most, ...others] = [...this.overlaps].sort((one, other) => other[1] - one[1]);
    if (!most) {
      return;
    }
    const named = most[0].split(' ').map((number) => {
      const name = this.segments.find((one) => one.number === Number(number))?.name ?? '';
      return `${number} ${name}`.trim();
    });
    const more = others.length > 0 ? ` and ${others.length} more pairs` : '';
    const found = `segments that overlap: ${named.join(' and ')} in ${most[1]} voxels${more}`;
    const mend = 'trace other segments with `lumencut trace --mask` and --label, or save them separately';
    throw formatFailure(this.path, found, 'at most one segment in each voxel', mend);
  }
}
