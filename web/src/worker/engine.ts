/** The connection of the page to the worker: the one `engine` that all parts of the page ask. Its methods throw `Failure`. */
import { proxy, type Remote, transfer, wrap } from 'comlink';
import { Failure } from '../core/failure';
import { type PlaceDoubt, TURNS } from '../core/generated/questions';
import type {
  Answer,
  Asked,
  Attachments,
  Drawn,
  GivenFile,
  Message,
  OnProgress,
  Question,
  Report,
  ScanStudy,
  SeriesWish,
  Started,
  States,
  View,
} from '../core/messages';
import { Precedence } from '../core/precedence';
import type { EngineHost } from './host';

/** Addresses of the files to load, on the same origin as the page. */
export interface Addresses {
  readonly volume: string | null;
  readonly centerlines: string | null;
}

export interface Opened {
  readonly report: Report;
  readonly notes: readonly string[];
  readonly name?: string;
  readonly states?: States;
  readonly study?: ScanStudy | null;
  /** Why the coordinate system of the centerlines is doubtful. */
  readonly doubt?: PlaceDoubt | null;
}

/** Bits of a byte shared with the worker: the first stops rendering, the second stops other long work. */
const STOP_VIEW = 1;
const STOP_LONG = 2;

export class EngineClient implements Asked {
  private readonly worker: Worker;
  private readonly host: Remote<EngineHost>;
  private stopByte: Uint8Array | null = null;
  private readonly precedence = new Precedence(() => this.stop());

  constructor() {
    this.worker = new Worker(new URL('./engine.worker.ts', import.meta.url), { type: 'module' });
    this.host = wrap<EngineHost>(this.worker);
  }

  /** Ends the worker and its compute threads; later requests fail. */
  end(): void {
    this.worker.terminate();
  }

  /** Sends a request to the engine. A request that the user waits for interrupts the rendering of a view. */
  ask<N extends Question>(
    name: N,
    message: Message<N>,
    { onProgress, ...files }: Attachments = {},
  ): Promise<Answer<N>> {
    const answer = this.host.ask(name, message, files, onProgress ? proxy(onProgress) : null) as Promise<
      Answer<N>
    >;
    return TURNS[name].when === 'first' ? this.first(answer) : typed(answer);
  }

  async start(device: string): Promise<Started> {
    const started = await typed(Promise.race([this.host.start(device), broken(this.worker)]));
    this.stopByte = started.stop && new Uint8Array(started.stop.buffer, started.stop.address, 1);
    return started;
  }

  /** Stops rendering the current view. Without shared memory, rendering cannot be stopped. */
  stop(): void {
    this.say(STOP_VIEW);
  }

  private say(bit: number): void {
    if (this.stopByte) {
      Atomics.or(this.stopByte, 0, bit);
    }
  }

  changeDevice(device: string): Promise<{ device: string; isGpu: boolean }> {
    return typed(this.host.changeDevice(device));
  }

  loss(): Promise<void> {
    return typed(this.host.loss());
  }

  memory(): Promise<number> {
    return typed(this.host.memory());
  }

  drawOn(canvas: OffscreenCanvas): Promise<void> {
    return typed(this.host.drawOn(transfer(canvas, [canvas])));
  }

  openPhantom(name: string, wish: SeriesWish = {}): Promise<Report> {
    return this.first(this.host.openPhantom(name, wish));
  }

  openAddresses(
    { volume, centerlines }: Addresses,
    wish: SeriesWish,
    onProgress: OnProgress,
  ): Promise<Opened> {
    return this.first(this.host.openAddresses(volume, centerlines, wish, proxy(onProgress)));
  }

  openFiles(files: readonly GivenFile[], wish: SeriesWish, onProgress: OnProgress): Promise<Opened> {
    return this.first(this.host.openFiles(files, wish, proxy(onProgress)));
  }

  checkFiles(files: readonly GivenFile[]): Promise<void> {
    return this.first(this.host.checkFiles(files));
  }

  fitsAsMask(files: readonly GivenFile[]): Promise<boolean> {
    return this.first(this.host.fitsAsMask(files));
  }

  dicomHead(file: GivenFile): Promise<Uint8Array<ArrayBuffer>> {
    return this.first(this.host.dicomHead(file));
  }

  /** Stops loading, tracing and measuring. Without shared memory, tracing or measuring that has begun continues. */
  cancel(): Promise<void> {
    this.say(STOP_LONG);
    return typed(this.host.cancel());
  }

  render(view: View): Promise<Drawn> {
    const isRefining = view.settings.context_preview !== true;
    return this.precedence.view(isRefining, typed(this.host.render(view)));
  }

  private first<T>(answer: Promise<T>): Promise<T> {
    return this.precedence.first(typed(answer));
  }
}

/** Fails if the worker does not load, for example because its file is missing or blocked. */
const broken = (worker: Worker): Promise<never> =>
  new Promise((_, reject) => {
    const fail = () =>
      reject(
        new Failure('unexpected', 'the engine', 'a worker that did not load', 'its file', 'reload the page'),
      );
    worker.addEventListener('error', fail, { once: true });
  });

async function typed<T>(answer: Promise<T>): Promise<T> {
  try {
    return await answer;
  } catch (error) {
    throw Failure.of(error);
  }
}

export type Engine = Pick<EngineClient, keyof EngineClient>;

/** The engine of the page. It is not passed as a parameter, except where there are two. */
export let engine: Engine;

/** Sets the engine when the page starts. Tests set one that answers only what they ask. */
export function connect(to: Partial<Engine>): void {
  engine = to as Engine;
}
