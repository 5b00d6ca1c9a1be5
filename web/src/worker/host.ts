/** The interface of the worker for the page. Errors are passed as the text of `Failure`. */
import { transfer } from 'comlink';
import { CRASH, crashed, Failure } from '../core/failure';
import type { PlaceDoubt } from '../core/generated/questions';
import type {
  Attachments,
  Drawn,
  GivenFile,
  Message,
  OnProgress,
  Picture,
  Question,
  Report,
  SeriesWish,
  Started,
  View,
} from '../core/messages';
import {
  canGrow,
  Engine,
  loadJudge,
  loadModule,
  loadPackedVolumes,
  loadVolumes,
  memorySize,
  type Shared,
  useThreads,
} from '../core/module';
import { ALL_OF_IT } from '../io/dicom/wanted';
import { EverySecond } from '../io/every-second';
import { among, BlobSource } from '../io/source';
import { Steps } from '../io/steps';
import { ask, askAtOnce, isAtOnce, kindOf, moved, refuseStopped } from './answers';
import { type Fetched, fetchStudy } from './fetching';
import { askWithFiles, fitsAsMask } from './masks';
import { type LoadContext, Replacing } from './replacing';

/** Tracing makes a copy of the voxels as 32-bit numbers. */
const BYTES_PER_VOXEL = 4;

const COARSER = 'only every second voxel along each axis was loaded; measurements are less accurate';

interface Loaded {
  readonly report: Report;
  readonly doubt: PlaceDoubt | null;
}

export class EngineHost {
  private readonly queue = new Queue();
  private engine: Engine | null = null;
  private cancelled = new AbortController();
  /** The crash of the module. Afterwards all requests fail, because its memory may be corrupt. */
  private crash: Error | null = null;
  /** What tracing the open volume may need besides it (bytes). */
  private needed = 0;

  /** Answers a request. Requests that need no study are answered at once, ahead of the queue. */
  ask(name: Question, message: unknown, files: Attachments, onProgress: OnProgress | null): unknown {
    const asked = message as Message<Question>;
    if (isAtOnce(name)) {
      this.ready();
      return askAtOnce(name, asked);
    }
    const { signal } = this.cancelled;
    const attachments = onProgress ? { ...files, onProgress } : files;
    return this.run(async () => {
      refuseStopped(name, signal);
      return moved(await askWithFiles(this.ready(), name, asked, { attachments, signal }));
    });
  }

  /** Loads the module and selects the device. */
  start(device: string): Promise<Started> {
    return this.run(async () => {
      const shared = await loadModule();
      const threads = await startThreads(shared);
      this.engine = await Engine.open(device);
      const buffer = shared.memory.buffer;
      const isShared = self.crossOriginIsolated && buffer instanceof SharedArrayBuffer;
      return {
        ...this.device(),
        threads,
        isIsolated: self.crossOriginIsolated,
        table: askAtOnce('settings_table', null),
        looks: askAtOnce('looks', null),
        regions: askAtOnce('regions', null),
        doubts: askAtOnce('doubt_rows', null),
        stop: isShared ? { buffer, address: Engine.stop_address() } : null,
      };
    });
  }

  private device(): { device: string; isGpu: boolean } {
    const device = this.ready().device();
    return { device, isGpu: device !== 'cpu' };
  }

  /** Switches the compute device, or starts the same one again after a loss. */
  changeDevice(device: string): Promise<{ device: string; isGpu: boolean }> {
    return this.run(async () => {
      await this.ready().change_device(device);
      return this.device();
    });
  }

  /** Resolves when the current GPU is lost. Waiting for this does not block other work. */
  async loss(): Promise<void> {
    const { lost } = await this.run(() => ({ lost: this.ready().loss() }));
    await lost;
  }

  memory(): Promise<number> {
    return this.run(memorySize);
  }

  drawOn(canvas: OffscreenCanvas): Promise<void> {
    return this.run(() => this.ready().draw_on(canvas));
  }

  openPhantom(name: string, wish: SeriesWish): Promise<Report> {
    return this.run(() => {
      this.ready().open_phantom(name, wish.every_second ? 0.5 : 1);
      return this.report();
    });
  }

  openAddresses(
    volume: string | null,
    centerlines: string | null,
    wish: SeriesWish,
    onProgress: OnProgress,
  ): Promise<Fetched & Loaded> {
    return this.load(onProgress, (context) => fetchStudy(context, { volume, centerlines }, onProgress), wish);
  }

  /** Opens files. If they are rejected early enough, the open study stays open. */
  openFiles(
    files: readonly GivenFile[],
    wish: SeriesWish,
    onProgress: OnProgress,
  ): Promise<Partial<Fetched> & Loaded & { notes: readonly string[] }> {
    const sources = files.map(({ path, file }) => new BlobSource(path, file));
    const { coordinates: _, unit: __, every_second: ___, reorder: ____, ...series } = wish;
    const work = async (context: LoadContext) => {
      const { openFiles } = await import('../io/study');
      const { volume, notes } = await openFiles(
        sources,
        among(sources),
        { ...ALL_OF_IT, ...series },
        context,
      );
      return volume ? { ...volume, notes } : { notes };
    };
    return this.load(onProgress, work, wish);
  }

  /** Rejects files that cannot be opened. The open study stays open. */
  checkFiles(files: readonly GivenFile[]): Promise<void> {
    return this.run(async () => {
      const { checkFiles } = await import('../io/study');
      const sources = files.map(({ path, file }) => new BlobSource(path, file));
      await checkFiles(sources, { kindOf, steps: new Steps(() => {}, this.cancelled.signal) });
    });
  }

  fitsAsMask(files: readonly GivenFile[]): Promise<boolean> {
    return this.run(() => fitsAsMask(this.ready(), files, new Steps(() => {}, this.cancelled.signal)));
  }

  dicomHead({ path, file }: GivenFile): Promise<Uint8Array<ArrayBuffer>> {
    return this.run(async () => {
      const { headOf } = await import('../io/dicom');
      return headOf(new BlobSource(path, file));
    });
  }

  /** Loads in steps, which `cancel` ends. If loading fails after the old study was closed, no study is open. */
  private load<T extends { readonly notes: readonly string[] }>(
    onProgress: OnProgress,
    work: (context: LoadContext) => Promise<T>,
    wish: SeriesWish,
  ): Promise<T & Loaded> {
    this.cancelled.abort();
    this.cancelled = new AbortController();
    const { signal } = this.cancelled;
    return this.run(async () => {
      const replacing = new Replacing(this.ready(), wish);
      const study = wish.every_second ? new EverySecond(replacing) : replacing;
      try {
        const steps = new Steps(onProgress, signal);
        const loaded = await work({ study, loadJudge, loadVolumes, loadPackedVolumes, kindOf, steps });
        const report = this.report();
        const voxels = report.volume?.size.reduce((product, side) => product * side, 1) ?? 0;
        this.needed = BYTES_PER_VOXEL * voxels;
        const ofVolume = (replacing.hasBegun && report.volume?.notes) || [];
        const every = [...loaded.notes, ...ofVolume, wish.every_second ? COARSER : null];
        const notes = [...new Set(every.filter((note) => note != null))];
        return { ...loaded, notes, report, doubt: replacing.doubt };
      } catch (error) {
        if (replacing.hasBegun) {
          replacing.close();
        }
        throw error;
      }
    });
  }

  cancel(): void {
    this.cancelled.abort();
    this.cancelled = new AbortController();
    if (this.engine) {
      Engine.cancellation_was_heard();
    }
  }

  /** Renders a view on the canvas by the GPU, or returns its pixels. */
  render(view: View): Promise<Drawn> {
    return this.run(async () => {
      const start = performance.now();
      const bytes = await this.ready().render(JSON.stringify(view));
      const milliseconds = performance.now() - start;
      return bytes
        ? sent({ size: view.camera.size, bytes: plain(bytes) }, milliseconds)
        : { picture: null, milliseconds };
    });
  }

  private report(): Report {
    return ask(this.ready(), 'report', null);
  }

  private ready(): Engine {
    if (this.crash) {
      throw this.crash;
    }
    if (!this.engine) {
      throw new Failure('unexpected', 'the engine', 'not started', 'a started engine');
    }
    return this.engine;
  }

  private run<T>(work: () => T | Promise<T>): Promise<T> {
    return this.queue.run(work).catch((error: unknown) => {
      const failure = Failure.of(error);
      if (failure.kind !== CRASH || this.crash) {
        throw new Error(failure.text);
      }
      const memory = memorySize();
      this.crash = new Error((canGrow(this.needed) ? failure : crashed('', memory)).text);
      throw this.crash;
    });
  }
}

function sent(picture: Picture, milliseconds: number): Drawn {
  return transfer({ picture, milliseconds }, [picture.bytes.buffer]);
}

/** The pixels as a plain array. They need no copy, since the engine has copied them. */
function plain(bytes: Uint8ClampedArray): Uint8ClampedArray<ArrayBuffer> {
  return bytes as Uint8ClampedArray<ArrayBuffer>;
}

/** Runs tasks one at a time, in order. */
export class Queue {
  private last: Promise<unknown> = Promise.resolve();

  run<T>(work: () => T | Promise<T>): Promise<T> {
    const next = this.last.then(work, work);
    this.last = next.catch(() => undefined);
    return next;
  }
}

/** Most threads; more would not help, because memory bandwidth limits rendering. */
const MAX_THREADS = 16;

export const THREAD = 'thread';

/** Starts one thread per logical core; returns their number. */
async function startThreads(shared: Shared): Promise<number> {
  const count = Math.min(navigator.hardwareConcurrency || 1, MAX_THREADS);
  if (!self.crossOriginIsolated || count < 2) {
    return 1;
  }
  await Promise.all(Array.from({ length: count }, () => startThread(shared)));
  useThreads(count);
  return count;
}

function startThread(shared: Shared): Promise<void> {
  // Threads use the same file as this worker, so that it is loaded and compiled only once.
  const worker = new Worker(self.location.href, { type: 'module', name: THREAD });
  return new Promise((resolve, reject) => {
    worker.onmessage = () => resolve();
    worker.onerror = (event) => reject(new Error(event.message || 'a worker did not start'));
    worker.postMessage(shared);
  });
}
