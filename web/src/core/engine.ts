/** The worker as the page uses it: typed calls whose errors are failures. */
import { proxy, type Remote, transfer, wrap } from 'comlink';
import type { EngineHost } from '../worker/host';
import { Failure } from './failure';
import type {
  Camera,
  Cpr,
  Drawn,
  GivenFile,
  Histogram,
  Pair,
  Pick,
  Picture,
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

export type Told = (progress: Progress) => void;

export interface Opened {
  readonly report: Report;
  readonly notes: readonly string[];
  readonly name?: string;
  readonly states?: States;
}

export class EngineClient {
  private readonly host: Remote<EngineHost>;
  private stopByte: Uint8Array | null = null;
  /** Whether the picture under way only refines what is shown already. */
  private isRefining = false;

  constructor() {
    const worker = new Worker(new URL('../worker/engine.worker.ts', import.meta.url), { type: 'module' });
    this.host = wrap<EngineHost>(worker);
  }

  async start(device: string): Promise<Started> {
    const started = await heard(this.host.start(device));
    this.stopByte = started.stop && new Uint8Array(started.stop.buffer, started.stop.address, 1);
    return started;
  }

  /** Stops the view under way, where the memory is shared; elsewhere it goes on to its end. */
  stop(): void {
    if (this.stopByte) {
      Atomics.store(this.stopByte, 0, 1);
    }
  }

  changeDevice(device: string): Promise<{ device: string; isGpu: boolean }> {
    return heard(this.host.changeDevice(device));
  }

  loseDevice(): Promise<void> {
    return heard(this.host.loseDevice());
  }

  memory(): Promise<number> {
    return heard(this.host.memory());
  }

  drawOn(canvas: OffscreenCanvas): Promise<void> {
    return heard(this.host.drawOn(transfer(canvas, [canvas])));
  }

  openPhantom(name: string): Promise<Report> {
    return this.first(this.host.openPhantom(name));
  }

  openAddresses(volume: string | null, centerlines: string | null, told: Told): Promise<Opened> {
    return this.first(this.host.openAddresses(volume, centerlines, proxy(told)));
  }

  openFiles(files: readonly GivenFile[], wish: SeriesWish, told: Told): Promise<Opened> {
    return this.first(this.host.openFiles(files, wish, proxy(told)));
  }

  /** What is open. */
  report(): Promise<Report> {
    return heard(this.host.whatIsOpen());
  }

  cancel(): Promise<void> {
    return heard(this.host.cancel());
  }

  close(): Promise<void> {
    return this.first(this.host.close());
  }

  fitted(view: string, [width, height]: Pair): Promise<Camera> {
    return this.first(this.host.fitted(view, width, height));
  }

  async render(view: View): Promise<Drawn> {
    this.isRefining = Number(view.settings.samples ?? 1) > 1;
    try {
      return await heard(this.host.render(view));
    } finally {
      this.isRefining = false;
    }
  }

  /** What the user waits for comes before a refinement, which starts again afterwards. */
  private first<T>(answer: Promise<T>): Promise<T> {
    if (this.isRefining) {
      this.stop();
    }
    return heard(answer);
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
