/** A volume file with a parsed header, and the transfer of its voxels to the engine. */
import { Failure } from '../core/failure';
import type { States } from '../core/messages';
import { byteCount, numbersOf, type StoredKind } from './numbers';
import { type Bytes, type Place, requireRoom, voxelBytes } from './payload';
import { conversion, needsRange, type Scaling } from './rescale';
import type { Labels } from './segments';
import type { Steps } from './steps';
import { formatFailure } from './words';

export type Size = readonly [number, number, number];
/** Matrix from voxel indices to world coordinates (LPS, mm), row by row. */
export type Affine = readonly (readonly number[])[];

interface Grid {
  readonly size: Size;
  readonly world_from_index: Affine;
  readonly scan?: object;
  readonly label_names?: object;
}

/** Receives voxels; implemented by the engine and by test doubles. */
export interface Sink {
  begin_volume(header: string): void;
  take_voxels(offset: number, bytes: Uint8Array): void;
  /** Share of the voxels that is kept; all if absent. */
  readonly share?: number;
}

/** A volume with a checked header and unread voxels. */
export interface VolumeFile {
  readonly path: string;
  readonly format: string;
  readonly size: Size;
  readonly worldFromIndex: Affine;
  readonly stored: StoredKind;
  readonly scaling: Scaling;
  readonly place: Place;
  readonly notes: readonly string[];
  readonly states: States;
  /** Description in the file. It may name a patient, so only the engine reads it. */
  readonly content?: string;
  readonly labels?: Labels | null;
}

/** Allocates a volume in the engine. Errors about its grid name the file. */
export function begin(sink: Sink, path: string, grid: Grid, dtype: string): void {
  try {
    sink.begin_volume(JSON.stringify({ ...grid, dtype }));
  } catch (error) {
    const failure = Failure.of(error);
    const { subject, found, expected, advice, more } = failure;
    throw failure.kind === 'volume'
      ? formatFailure(path, `${subject} ${found}`, expected, advice, more)
      : failure;
  }
}

export async function load(file: VolumeFile, sink: Sink, steps: Steps): Promise<void> {
  requireNumbers(file);
  const needed = file.size.reduce((count, side) => count * side, storedBytes(file));
  await requireRoom({ ...file.place, share: sink.share ?? 1 }, needed, file.stored.kind, steps);
  const isWanted = needsRange(file.stored.kind, file.scaling);
  const range = isWanted ? await rangeOf(file, needed, steps) : null;
  const map = file.labels?.map;
  const { kind, convert } = map
    ? { kind: map.kind, convert: (bytes: Bytes) => map.convert(bytes) }
    : conversion(orderInMemory(file), file.scaling, range);
  const names = file.labels && { label_names: file.labels.names };
  begin(sink, file.path, { size: file.size, world_from_index: file.worldFromIndex, ...names }, kind);
  let offset = 0;
  for await (const bytes of wholeVoxels(file, needed)) {
    const voxels = convert(bytes);
    sink.take_voxels(offset, voxels);
    offset += voxels.length;
    await steps.step('Volume', (offset / byteCount(kind)) * storedBytes(file), needed);
  }
  map?.refuseOverlaps();
}

const storedBytes = ({ stored, labels }: VolumeFile): number =>
  byteCount(stored.kind) * (labels?.layers ?? 1);

/** Throws if the grid contains a number that is not finite, since JSON cannot represent it. */
function requireNumbers(file: VolumeFile): void {
  if (!file.worldFromIndex.flat().every(Number.isFinite)) {
    const found = 'a number in world_from_index that is not finite';
    throw formatFailure(file.path, found, 'finite numbers', 'correct the position of the volume');
  }
}

/** Type and byte order of the voxels in memory; values parsed from text have native byte order. */
function orderInMemory({ stored, place }: VolumeFile): StoredKind {
  return place.codec === 'text' ? { ...stored, isBig: false } : stored;
}

async function rangeOf(file: VolumeFile, needed: number, steps: Steps): Promise<readonly [number, number]> {
  let [low, high, done] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY, 0];
  for await (const bytes of wholeVoxels(file, needed)) {
    done += bytes.length;
    for (const value of numbersOf(orderInMemory(file), bytes)) {
      low = Math.min(low, Number(value));
      high = Math.max(high, Number(value));
    }
    await steps.step('Checking the volume', done, needed);
  }
  return [low, high];
}

async function* wholeVoxels(file: VolumeFile, needed: number): AsyncGenerator<Bytes> {
  const unit = storedBytes(file);
  let begun: Bytes = new Uint8Array();
  for await (const piece of voxelBytes(file.place, needed, file.stored.kind)) {
    const bytes = begun.length === 0 ? piece : joined(begun, piece);
    const whole = bytes.length - (bytes.length % unit);
    begun = bytes.slice(whole);
    if (whole > 0) {
      yield bytes.subarray(0, whole);
    }
  }
}

export function joined(first: Uint8Array, second: Uint8Array): Bytes {
  const both = new Uint8Array(first.length + second.length);
  both.set(first);
  both.set(second, first.length);
  return both;
}
