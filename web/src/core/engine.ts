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
    return heard(this.host.openPhantom(name));
  }

  openAddresses(volume: string | null, centerlines: string | null, told: Told): Promise<Opened> {
    return heard(this.host.openAddresses(volume, centerlines, proxy(told)));
  }

  openFiles(files: readonly GivenFile[], wish: SeriesWish, told: Told): Promise<Opened> {
    return heard(this.host.openFiles(files, wish, proxy(told)));
  }

  /** What is open. */
  report(): Promise<Report> {
    return heard(this.host.whatIsOpen());
  }

  openCenterlines(bytes: Uint8Array, name: string): Promise<Opened> {
    return heard(this.host.openCenterlines(bytes, name));
  }

  cancel(): Promise<void> {
    return heard(this.host.cancel());
  }

  close(): Promise<void> {
    return heard(this.host.close());
  }

  fitted(view: string, [width, height]: Pair): Promise<Camera> {
    return heard(this.host.fitted(view, width, height));
  }

  render(view: View): Promise<Drawn> {
    return heard(this.host.render(view));
  }

  pick(view: View, [column, row]: Pair): Promise<Pick> {
    return heard(this.host.pick(view, column, row));
  }

  at(point: Vector): Promise<Pick> {
    return heard(this.host.at(point));
  }

  slice(plane: Plane, window: Window): Promise<Picture> {
    return heard(this.host.slice(plane, window));
  }

  across(vessel: number, at: number): Promise<[Vector, Vector, Vector]> {
    return heard(this.host.across(vessel, at));
  }

  straightened(cpr: Cpr, window: Window): Promise<Picture> {
    return heard(this.host.straightened(cpr, window));
  }

  pickStraightened([column, row]: Pair): Promise<Pick> {
    return heard(this.host.pickStraightened(column, row));
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
