/** Keeps only every second voxel along each axis while a volume is read, which needs an eighth of the memory. */
import { Failure } from '../core/failure';
import type { Study } from './study';
import type { Size } from './volume-file';

/** A study that can first close the previous study. */
interface Closable extends Study {
  close(): void;
}

interface Header {
  readonly size: Size;
  readonly dtype: string;
  readonly world_from_index: readonly (readonly number[])[];
}

export const ARRAYS = {
  uint8: Uint8Array,
  int16: Int16Array,
  uint16: Uint16Array,
  float32: Float32Array,
} as const;

export class EverySecond implements Study {
  readonly share = 1 / 8;
  private size: Size = [0, 0, 0];
  private Voxels: (typeof ARRAYS)[keyof typeof ARRAYS] = Uint8Array;

  constructor(private readonly study: Closable) {}

  close(): void {
    this.study.close();
  }

  openCenterlines(bytes: Uint8Array, name: string): readonly string[] {
    return this.study.openCenterlines(bytes, name);
  }

  sideNotes(text: string): readonly string[] {
    return this.study.sideNotes?.(text) ?? [];
  }

  begin_volume(text: string): void {
    const header: Header = JSON.parse(text);
    if (!Object.hasOwn(ARRAYS, header.dtype)) {
      throw new Failure('volume', 'type of the voxels', header.dtype, Object.keys(ARRAYS).join(', '));
    }
    this.size = header.size;
    this.Voxels = ARRAYS[header.dtype as keyof typeof ARRAYS];
    this.study.begin_volume(JSON.stringify({ ...header, ...halved(header) }));
  }

  /** Keeps the voxels whose indices i, j and k are even. Voxels arrive in storage order. */
  take_voxels(offset: number, bytes: Uint8Array): void {
    const unit = this.Voxels.BYTES_PER_ELEMENT;
    const whole = bytes.byteOffset % unit === 0 ? bytes : bytes.slice();
    const voxels = new this.Voxels(whole.buffer as ArrayBuffer, whole.byteOffset, whole.length / unit);
    const first = offset / unit;
    const kept = new this.Voxels(Math.ceil(voxels.length / 2));
    let [at, count] = [-1, 0];
    for (const [row, from, to] of this.rows(first, first + voxels.length)) {
      const start = from + (from % 2);
      at = at < 0 && start < to ? this.keptBefore(row) + start / 2 : at;
      for (let i = start; i < to; i += 2) {
        kept[count] = voxels[row * this.size[0] + i - first] ?? 0;
        count += 1;
      }
    }
    if (count > 0) {
      this.study.take_voxels(at * unit, new Uint8Array(kept.buffer, 0, count * unit));
    }
  }

  /** Rows with even j and k among the voxels from `first` to `end`, each with its range of i. */
  private *rows(first: number, end: number): Generator<[row: number, from: number, to: number]> {
    const [ni, nj] = this.size;
    for (let row = Math.floor(first / ni); row * ni < end; row += 1) {
      if ((row % nj) % 2 === 0 && Math.floor(row / nj) % 2 === 0) {
        yield [row, Math.max(first - row * ni, 0), Math.min(end - row * ni, ni)];
      }
    }
  }

  private keptBefore(row: number): number {
    const [ni, nj] = this.size;
    const rows = (Math.floor(row / nj) / 2) * Math.ceil(nj / 2) + (row % nj) / 2;
    return rows * Math.ceil(ni / 2);
  }
}

/** Size and grid of the kept voxels; the first voxel keeps its position. */
function halved({ size, world_from_index }: Header): Pick<Header, 'size' | 'world_from_index'> {
  const doubled = (row: readonly number[]) => row.map((value, column) => (column < 3 ? 2 * value : value));
  const [ni, nj, nk] = size;
  return {
    size: [Math.ceil(ni / 2), Math.ceil(nj / 2), Math.ceil(nk / 2)],
    world_from_index: world_from_index.map(doubled),
  };
}
