/** The worker as the page uses it: typed calls whose errors are failures. */
import { proxy, type Remote, transfer, wrap } from 'comlink';
import type { EngineHost } from '../worker/host';
import { Failure } from './failure';
import type { Measuring } from './measuring';
import { MeasuringClient } from './measuring-client';
import type {
  Camera,
  Cpr,
  Drawn,
  GivenFile,
  Histogram,
  LaidPicture,
  Pair,
  Pick,
  Picture,
  PictureLabels,
  Plane,
  Progress,
  Report,
  SeriesWish,
  Started,
  States,
  Vector,
  View,
  Window,
} from './messages';
import { Precedence } from './precedence';
import { SessionClient } from './session-client';
import type { Sessions } from './session-file';
import type { Tracing } from './tracing';
import { TracingClient } from './tracing-client';

export type Told = (progress: Progress) => void;

/** Files of the same origin. */
export interface Addresses {
  readonly volume: string | null;
  readonly centerlines: string | null;
}

export interface Opened {
  readonly report: Report;
  readonly notes: readonly string[];
  readonly name?: string;
  readonly states?: States;
}

/** Bits of the byte that stops work: a view gives way to whatever the user waits for, long work to `cancel` alone. */
const STOP_VIEW = 1;
const STOP_LONG = 2;

export class EngineClient {
  readonly tracing: Tracing;
  readonly sessions: Sessions;
  readonly measuring: Measuring;
  private readonly host: Remote<EngineHost>;
  private stopByte: Uint8Array | null = null;
  private readonly precedence = new Precedence(() => this.stop());

  constructor() {
    const worker = new Worker(new URL('../worker/engine.worker.ts', import.meta.url), { type: 'module' });
    this.host = wrap<EngineHost>(worker);
    this.tracing = new TracingClient(this.host.tracing, (answer) => this.first(answer));
    this.sessions = new SessionClient(this.host.sessions, (answer) => this.first(answer));
    this.measuring = new MeasuringClient(this.host.measuring, (answer) => this.first(answer));
  }

  async start(device: string): Promise<Started> {
    const started = await heard(this.host.start(device));
    this.stopByte = started.stop && new Uint8Array(started.stop.buffer, started.stop.address, 1);
    return started;
  }

  /** Stops the view under way, where the memory is shared; elsewhere it goes on to its end. */
  stop(): void {
    this.ask(STOP_VIEW);
  }

  private ask(bit: number): void {
    if (this.stopByte) {
      Atomics.or(this.stopByte, 0, bit);
    }
  }

  changeDevice(device: string): Promise<{ device: string; isGpu: boolean }> {
    return heard(this.host.changeDevice(device));
  }

  /** Ends once the GPU that computes now is lost. */
  loss(): Promise<void> {
    return heard(this.host.loss());
  }

  memory(): Promise<number> {
    return heard(this.host.memory());
  }

  drawOn(canvas: OffscreenCanvas): Promise<void> {
    return heard(this.host.drawOn(transfer(canvas, [canvas])));
  }

  openPhantom(name: string, wish: SeriesWish = {}): Promise<Report> {
    return this.first(this.host.openPhantom(name, wish));
  }

  openAddresses({ volume, centerlines }: Addresses, wish: SeriesWish, told: Told): Promise<Opened> {
    return this.first(this.host.openAddresses(volume, centerlines, wish, proxy(told)));
  }

  openFiles(files: readonly GivenFile[], wish: SeriesWish, told: Told): Promise<Opened> {
    return this.first(this.host.openFiles(files, wish, proxy(told)));
  }

  /** What is open. */
  report(): Promise<Report> {
    return heard(this.host.whatIsOpen());
  }

  /** Stops loading, tracing and measuring; the last two, once under way, only where the memory is shared. */
  cancel(): Promise<void> {
    this.ask(STOP_LONG);
    return heard(this.host.cancel());
  }

  close(): Promise<void> {
    return this.first(this.host.close());
  }

  fitted(view: string, [width, height]: Pair): Promise<Camera> {
    return this.first(this.host.fitted(view, width, height));
  }

  render(view: View): Promise<Drawn> {
    const isRefining = view.settings.context_preview !== true;
    return this.precedence.view(isRefining, heard(this.host.render(view)));
  }

  /** An answer that the user waits for. */
  private first<T>(answer: Promise<T>): Promise<T> {
    return this.precedence.first(heard(answer));
  }

  pick(view: View, [column, row]: Pair): Promise<Pick> {
    return this.first(this.host.pick(view, column, row));
  }

  at(point: Vector): Promise<Pick> {
    return this.first(this.host.at(point));
  }

  slice(plane: Plane, window: Window): Promise<Picture> {
    return this.first(this.host.slice(plane, window));
  }

  across(vessel: number, at: number): Promise<[Vector, Vector, Vector]> {
    return this.first(this.host.across(vessel, at));
  }

  /** The letters and the scale bar of a picture; no view gives way to them. */
  labels(picture: LaidPicture): Promise<PictureLabels> {
    return heard(this.host.labels(picture));
  }

  straightened(cpr: Cpr, window: Window): Promise<Picture> {
    return this.first(this.host.straightened(cpr, window));
  }

  pickStraightened([column, row]: Pair): Promise<Pick> {
    return this.first(this.host.pickStraightened(column, row));
  }

  onStraightened(point: Vector): Promise<[number, number] | null> {
    return heard(this.host.onStraightened(point));
  }

  histogram(bins: number): Promise<Histogram> {
    return heard(this.host.histogram(bins));
  }
}

async function heard<T>(answer: Promise<T>): Promise<T> {
  try {
    return await answer;
  } catch (error) {
    throw Failure.of(error);
  }
}
