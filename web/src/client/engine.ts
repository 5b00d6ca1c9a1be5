/** The worker as the page uses it: typed calls whose errors are failures. */
import { proxy, type Remote, transfer, wrap } from 'comlink';
import type { Answer, Asked, Beside, Message, Question, Told } from '../core/asked';
import { Failure } from '../core/failure';
import { type PlaceDoubt, TURNS } from '../core/generated/questions';
import type { Drawn, GivenFile, Report, SeriesWish, Started, States, View } from '../core/messages';
import { Precedence } from '../core/precedence';
import type { ScanStudy } from '../core/scan-study';
import type { EngineHost } from '../worker/host';

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
  readonly study?: ScanStudy | null;
  /** What speaks against where centerlines were read. */
  readonly doubt?: PlaceDoubt | null;
}

/** Bits of the byte that stops work: a view gives way to whatever the user waits for, long work to `cancel` alone. */
const STOP_VIEW = 1;
const STOP_LONG = 2;

export class EngineClient implements Asked {
  private readonly worker: Worker;
  private readonly host: Remote<EngineHost>;
  private stopByte: Uint8Array | null = null;
  private readonly precedence = new Precedence(() => this.stop());

  constructor() {
    this.worker = new Worker(new URL('../worker/engine.worker.ts', import.meta.url), { type: 'module' });
    this.host = wrap<EngineHost>(this.worker);
  }

  /** Ends the worker, and with it the threads that compute for it; nothing can be asked afterwards. */
  end(): void {
    this.worker.terminate();
  }

  /** The answer to a question of the table; those that the user waits for come before the view under way. */
  ask<N extends Question>(name: N, message: Message<N>, { told, ...files }: Beside = {}): Promise<Answer<N>> {
    const answer = this.host.ask(name, message, files, told ? proxy(told) : null) as Promise<Answer<N>>;
    return TURNS[name].when === 'first' ? this.first(answer) : heard(answer);
  }

  async start(device: string): Promise<Started> {
    const started = await heard(this.host.start(device));
    this.stopByte = started.stop && new Uint8Array(started.stop.buffer, started.stop.address, 1);
    return started;
  }

  /** Stops the view under way, where the memory is shared; elsewhere it goes on to its end. */
  stop(): void {
    this.say(STOP_VIEW);
  }

  private say(bit: number): void {
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

  /** What of a DICOM file stands before its pixels. */
  dicomHead(file: GivenFile): Promise<Uint8Array<ArrayBuffer>> {
    return this.first(this.host.dicomHead(file));
  }

  /** Stops loading, tracing and measuring; the last two, once under way, only where the memory is shared. */
  cancel(): Promise<void> {
    this.say(STOP_LONG);
    return heard(this.host.cancel());
  }

  render(view: View): Promise<Drawn> {
    const isRefining = view.settings.context_preview !== true;
    return this.precedence.view(isRefining, heard(this.host.render(view)));
  }

  /** An answer that the user waits for. */
  private first<T>(answer: Promise<T>): Promise<T> {
    return this.precedence.first(heard(answer));
  }
}

async function heard<T>(answer: Promise<T>): Promise<T> {
  try {
    return await answer;
  } catch (error) {
    throw Failure.of(error);
  }
}
