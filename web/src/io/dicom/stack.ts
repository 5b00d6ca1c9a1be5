/** Assembles the slices of a plan into one volume, and interpolates missing slices. */
import {
  ARRAYS,
  byteCount,
  bytesOf,
  holding,
  inTheEngine,
  isInteger,
  type Kind,
  kindName,
  type Numbers,
} from '../numbers';
import type { Steps } from '../steps';
import { begin, type Sink } from '../volume-file';
import type { ExaminedFile } from './headers';
import type { Plan, PlannedSlice } from './judging';
import { PixelReader } from './pixels';

type Range = readonly [number, number];

/** Type of the voxels, and whether all values are integers, even if stored as floats. */
interface Type {
  readonly kind: Kind;
  readonly isWhole: boolean;
}

/** Reads the slices into the narrowest voxel type that can hold all values. */
export async function loadStack(
  subject: string,
  plan: Plan,
  files: readonly ExaminedFile[],
  sink: Sink,
  steps: Steps,
): Promise<void> {
  const isWhole = plan.slices.every(isIntegral) && plan.slices.every((slice) => !isFloat(slice, files));
  let kind: Kind = isWhole ? 'int16' : 'float32';
  for (;;) {
    begin(sink, subject, { size: plan.size, world_from_index: plan.world_from_index, scan: plan.scan }, kind);
    const wider = await new Filler(plan, files, sink, { kind, isWhole }).fill(steps);
    if (wider === null) {
      return;
    }
    kind = wider;
  }
}

function isFloat({ file }: PlannedSlice, files: readonly ExaminedFile[]): boolean {
  return files[file]?.image?.pixels?.keyword !== 'PixelData';
}

/** Fills a volume of one voxel type; stops if a value does not fit. */
class Filler {
  private readonly reader = new PixelReader();
  private range: Range = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  private before: Numbers | null = null;
  private nextFill = 0;

  constructor(
    private readonly plan: Plan,
    private readonly files: readonly ExaminedFile[],
    private readonly sink: Sink,
    private readonly type: Type,
  ) {}

  private get kind(): Kind {
    return this.type.kind;
  }

  /** Reads all slices. Returns a wider type if a value does not fit, otherwise null. */
  async fill(steps: Steps): Promise<Kind | null> {
    for (const [number, slice] of this.plan.slices.entries()) {
      const values = await this.values(slice);
      const wider = this.widened(values);
      if (wider) {
        return wider;
      }
      const own =
        kindName(values) === this.kind ? values : new ARRAYS[this.kind as 'int16'](values as Int16Array);
      if (Number.isInteger(slice.place)) {
        this.put(slice.place, own);
      }
      this.fillUpTo(number, own);
      this.before = own;
      await steps.step('Slices', number + 1, this.plan.slices.length);
    }
    return null;
  }

  private async values(slice: PlannedSlice): Promise<Numbers> {
    const image = this.files[slice.file]?.image;
    if (!image) {
      throw new Error('the plan of the volume names a file without a header');
    }
    return inUnit(await this.reader.read(image, slice.frame), slice);
  }

  /** The type that these values need; null if the current type can hold them. */
  private widened(values: Numbers): Kind | null {
    if (this.kind === 'float32') {
      return null;
    }
    if (!isInteger(kindName(values))) {
      return 'float32';
    }
    const [low, high] = rangeOf(values);
    this.range = [Math.min(low, this.range[0]), Math.max(high, this.range[1])];
    const kind = inTheEngine(holding(...this.range, this.kind) ?? 'float32');
    return kind === this.kind ? null : kind;
  }

  private put(place: number, values: Numbers): void {
    const [ni, nj] = this.plan.size;
    this.sink.take_voxels(place * ni * nj * byteCount(this.kind), bytesOf(values));
  }

  private fillUpTo(number: number, values: Numbers): void {
    for (;;) {
      const fill = this.plan.fills[this.nextFill];
      if (!fill || fill.after !== number || !this.before) {
        return;
      }
      this.put(fill.k, mixed(this.before, values, fill.part, this.type));
      this.nextFill += 1;
    }
  }
}

/** Computes slope · stored + intercept; the result is an integer array if values, slope and intercept are integers. */
export function inUnit(stored: Numbers, scaling: Scaling): Numbers {
  if (!isScaled(scaling)) {
    return stored;
  }
  const isWhole = isInteger(kindName(stored)) && isIntegral(scaling);
  if (!isWhole) {
    return scaled(stored, scaling, 'float32');
  }
  const ends = rangeOf(stored).map((end) => end * scaling.slope + scaling.intercept);
  return scaled(
    stored,
    scaling,
    holding(Math.min(...ends), Math.max(...ends), 'int32') === 'int32' ? 'int32' : 'float64',
  );
}

function rangeOf(values: Numbers): Range {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values as Int16Array) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return [low, high];
}

function mixed(before: Numbers, after: Numbers, part: number, { kind, isWhole }: Type): Numbers {
  const result = new ARRAYS[kind as 'float64'](before.length);
  const round = isWhole ? toEven : (value: number) => value;
  for (let i = 0; i < result.length; i += 1) {
    result[i] = round((1 - part) * Number(before[i]) + part * Number(after[i]));
  }
  return result;
}

/** Rounds to the nearest integer; a tie goes to the even one. */
function toEven(value: number): number {
  const low = Math.floor(value);
  const above = value - low;
  return above > 0.5 || (above === 0.5 && low % 2 !== 0) ? low + 1 : low;
}

interface Scaling {
  readonly slope: number;
  readonly intercept: number;
}

function isScaled({ slope, intercept }: Scaling): boolean {
  return slope !== 1 || intercept !== 0;
}

/** Whether integers stay integers under slope and intercept. */
function isIntegral({ slope, intercept }: Scaling): boolean {
  return Number.isInteger(slope) && Number.isInteger(intercept);
}

/** Scales numbers with 64-bit precision, and converts them to another type. */
export function scaled(numbers: Numbers, { slope, intercept }: Scaling, kind: Kind): Numbers {
  const result = new ARRAYS[kind as 'float64'](numbers.length);
  for (let i = 0; i < numbers.length; i += 1) {
    result[i] = Number(numbers[i]) * slope + intercept;
  }
  return result;
}
