/** Reads volume files with the crate `lumencut-volumes`, and transfers their voxels to the engine. */
import { Failure } from '../core/failure';
import { EVERY_SECOND } from '../core/mends';
import type { Opening, Plan, Step, VolumeFile, Volumes } from '../core/volumes';
import { Ahead, type Beside, besidePath, fileName, type Source } from './source';
import type { Steps } from './steps';
import { Unpacked, Unverified } from './unpacked';
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
  /** Copies the bytes before it returns. */
  take_voxels(offset: number, bytes: Uint8Array): void;
  /** Share of the voxels that is kept; all if absent. */
  readonly share?: number;
}

interface Means {
  readonly beside: Beside;
  readonly loadVolumes: () => Promise<Volumes>;
  readonly loadPackedVolumes: () => Promise<Volumes>;
  readonly sink: Sink;
  readonly steps: Steps;
}

/** Largest memory of WebAssembly (bytes). */
const MEMORY = 2 ** 32;

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

/** Reads a volume file, or either file of a pair. After a failure the module with decoders states what is wrong. */
export async function readVolume(source: Source, means: Means): Promise<Plan> {
  try {
    return await read(source, means, await means.loadVolumes(), true);
  } catch (error) {
    if (means.steps.signal.aborted) {
      throw error;
    }
    return read(source, means, await means.loadPackedVolumes(), false);
  }
}

async function read(source: Source, means: Means, volumes: Volumes, unpacks: boolean): Promise<Plan> {
  const file = new volumes.VolumeFile(fileName(source.path));
  const reading = new Reading(source, file, means, volumes.memory, unpacks);
  try {
    return await reading.read();
  } finally {
    await reading.close();
    file.free();
  }
}

class Reading {
  private readonly path: string;
  /** Files by their names relative to the folder, and the content of those that are gzipped. */
  private readonly sources = new Map<string, Source | null>();
  private readonly unpacked = new Map<string, Unpacked>();

  constructor(
    source: Source,
    private readonly file: VolumeFile,
    private readonly means: Means,
    private readonly memory: WebAssembly.Memory,
    /** Whether the browser unpacks gzip, not the module. */
    private readonly unpacks: boolean,
  ) {
    this.path = source.path;
    this.sources.set(fileName(source.path), source);
  }

  async close(): Promise<void> {
    for (const one of this.unpacked.values()) {
      await one.close();
    }
  }

  async read(): Promise<Plan> {
    const plan = await this.plan();
    if (!plan.nifti) {
      this.requirePlain();
    }
    await this.fill(plan, gridOf(plan, [...this.file.world_from_index()]));
    return plan;
  }

  private async plan(): Promise<Plan> {
    for (;;) {
      const answer: Opening = JSON.parse(this.asked(() => this.file.open()));
      if ('sizes' in answer) {
        for (const name of answer.sizes) {
          this.file.add_size(name, (await this.content(name))?.size);
        }
      } else if ('bytes' in answer) {
        const [start, end] = answer.range;
        const source = await this.content(answer.bytes);
        this.file.add_bytes(answer.bytes, start, (await source?.slice(start, end)) ?? new Uint8Array());
      } else {
        return answer;
      }
    }
  }

  private async source(name: string): Promise<Source | null> {
    if (!this.sources.has(name)) {
      this.sources.set(name, await this.means.beside(besidePath(this.path, name)));
    }
    return this.sources.get(name) ?? null;
  }

  /** Only NIfTI files may be gzipped as a whole. */
  private requirePlain(): void {
    if ([...this.unpacked.values()].some((content) => content.isBegun)) {
      throw new Unverified();
    }
    this.unpacked.clear();
  }

  private async content(name: string): Promise<Source | null> {
    const source = await this.source(name);
    if (this.unpacks && source && !this.unpacked.has(name)) {
      await this.unpack(name, source, 0);
    }
    return this.unpacked.get(name) ?? source;
  }

  private async unpack(name: string, source: Source, from: number): Promise<Unpacked | null> {
    const content = await Unpacked.of(source, from);
    if (content) {
      await this.unpacked.get(name)?.close();
      this.unpacked.set(name, content);
    }
    return content;
  }

  private async voxels(plan: Plan): Promise<Source | null> {
    const source = await this.source(plan.voxels);
    if (!this.unpacks || !source) {
      return source;
    }
    if (plan.packed) {
      return plan.stream === null ? null : this.unpack(plan.voxels, source, plan.stream);
    }
    return plan.nifti ? this.content(plan.voxels) : source;
  }

  private async fill(plan: Plan, grid: Grid): Promise<void> {
    const { file, means } = this;
    const source = await this.voxels(plan);
    if (this.unpacks && plan.packed && !source) {
      throw new Unverified();
    }
    this.asked(() => file.begin(source?.size, this.unpacks && plan.packed));
    const pieces = source instanceof Unpacked ? source : new Ahead(source);
    let [offset, all] = [0, 0];
    for (;;) {
      const step: Step = JSON.parse(this.asked(() => file.step()));
      if (step.filled > 0) {
        means.sink.take_voxels(offset, new Uint8Array(this.memory.buffer, file.output(), step.filled));
        offset += step.filled;
      }
      if (step.isDone) {
        break;
      }
      this.refuseLarge(source?.path ?? this.path, step.least ?? 0);
      if (step.room) {
        all = step.room.bytes;
        begin(means.sink, this.path, grid, step.room.dtype);
      }
      if (step.read) {
        const [start] = step.read;
        file.read(start, await pieces.from(start));
      }
      const isChecking = all === 0;
      await means.steps.step(isChecking ? 'Checking the volume' : 'Volume', offset, isChecking ? null : all);
    }
    for (const content of [...this.unpacked.values()].filter(({ isBegun }) => isBegun)) {
      await content.finish(() => means.steps.step('Volume', offset, all));
    }
  }

  private refuseLarge(path: string, least: number): void {
    if (least * (this.means.sink.share ?? 1) > MEMORY) {
      const found = `${least} bytes of voxels as the header says`;
      const expected = `at most the ${MEMORY} bytes that a page can hold`;
      throw formatFailure(path, found, expected, '', { mends: [EVERY_SECOND] });
    }
  }

  /** Calls the module; its errors name files without their folder, which is added here. */
  private asked<T>(question: () => T): T {
    try {
      return question();
    } catch (error) {
      const { kind, subject, found, expected, advice } = Failure.of(error);
      throw new Failure(kind, besidePath(this.path, subject), found, expected, advice);
    }
  }
}

function gridOf({ size, label_names }: Plan, numbers: readonly number[]): Grid {
  const rows = [numbers.slice(0, 4), numbers.slice(4, 8), numbers.slice(8), [0, 0, 0, 1]];
  const grid = { size, world_from_index: rows };
  return Object.keys(label_names).length > 0 ? { ...grid, label_names } : grid;
}
