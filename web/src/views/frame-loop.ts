/** Renders the turning view: in low resolution while it moves, in full resolution at rest, then supersampled. */

import { sampled } from '../core/camera';
import { Failure } from '../core/failure';
import type { Drawn, Settings, View } from '../core/messages';
import { engine } from '../worker/engine';

/** Wanted time of a frame while the view moves (ms): 16 frames per second, and sharp ones. */
const MOVING_TIME = 61;
/** The view counts as at rest after this time without change (ms). */
const REST_AFTER = 80;
/** The pause before an interrupted view is rendered again doubles each time, up to this multiple of the first. */
const MOST_PAUSES = 16;
/** Lowest resolution while moving, as a share of the full resolution. */
const COARSEST = 0.2;
/** Most picture pixels per CSS pixel, on high-resolution screens. */
const MOST_DENSE = 2;
/** Supersampling uses 2 × 2 samples per pixel, if a plain picture takes less than this time (ms). */
const SAMPLES = 2;
const SAMPLED_WITHIN = 700;

type Stage = 'moving' | 'full' | 'samples' | 'done';

export interface Shown {
  /** The requested view, before its resolution was adapted. */
  readonly wanted: View;
  readonly view: View;
  readonly drawn: Drawn;
  readonly stage: Stage;
  /** Whether no better picture of the current view will follow. */
  readonly isLast: boolean;
}

export class FrameLoop {
  private wanted: View | null = null;
  private changed = 0;
  private stage: Stage = 'done';
  private isBusy = false;
  private isStopped = false;
  /** Whether the device changed while a frame was rendered; then its result or failure is ignored. */
  private isOutdated = false;
  /** Whether the next frame at rest is the first on its device; its time includes shader compilation. */
  private isFirst = false;
  private factor = 1;
  private gaveWay = 0;
  private timer = 0;

  constructor(
    private readonly show: (shown: Shown) => void,
    private readonly fail: (failure: Failure) => void,
  ) {}

  want(view: View): void {
    this.wanted = view;
    this.changed = performance.now();
    this.gaveWay = 0;
    if (this.isBusy && (this.stage === 'full' || this.stage === 'samples')) {
      engine.stop();
    }
    this.stage = 'moving';
    this.next();
  }

  again(): void {
    if (this.isBusy) {
      this.isOutdated = true;
    } else if (this.wanted) {
      // Start again at low resolution, since the first frames are slowed down by shader compilation.
      this.isFirst = true;
      this.want(this.wanted);
    }
  }

  end(): void {
    this.isStopped = true;
    window.clearTimeout(this.timer);
  }

  private next(): void {
    window.clearTimeout(this.timer);
    if (this.isBusy || this.isStopped || !this.wanted || this.stage === 'done') {
      return;
    }
    void this.draw(this.wanted, this.stage);
  }

  private async draw(view: View, stage: Stage): Promise<void> {
    this.isBusy = true;
    const asked = this.atStage(view, stage);
    try {
      const drawn = await engine.render(asked);
      this.gaveWay = 0;
      const next = this.stageAfter(view, stage, drawn.milliseconds);
      if (!this.isStopped && !this.isOutdated) {
        this.adapt(asked, view, drawn.milliseconds, stage);
        this.show({ wanted: view, view: asked, drawn, stage, isLast: next === 'done' });
      }
      this.isBusy = false;
      if (!this.beginsAnew()) {
        this.goOn(stage, next);
      }
    } catch (error) {
      this.isBusy = false;
      const failure = Failure.of(error);
      if (this.beginsAnew()) {
        return;
      }
      if (failure.kind === 'interrupted') {
        this.tryAgain(stage);
      } else if (!this.isStopped) {
        this.stage = 'done';
        this.fail(failure);
      }
    }
  }

  /** If the device has changed, renders again. Returns whether it has. */
  private beginsAnew(): boolean {
    const isOutdated = this.isOutdated;
    this.isOutdated = false;
    if (isOutdated) {
      this.again();
    }
    return isOutdated;
  }

  private atStage(view: View, stage: Stage): View {
    // Lines become smooth at the end, by samples everywhere.
    const moving: Settings = { ...view.settings, edge_samples: 1 };
    if (stage === 'moving') {
      const settings = { ...moving, context_preview: true, samples: 1 };
      return { ...view, camera: sampled(view.camera, this.factor), settings };
    }
    const plain: Settings = { ...moving, turning_limit: null };
    const camera = sampled(view.camera, Math.min(window.devicePixelRatio || 1, MOST_DENSE));
    const settings = stage === 'samples' ? { ...plain, samples: SAMPLES } : plain;
    return { ...view, camera, settings };
  }

  /** Adapts the resolution of moving frames to the time they take, by at most half. Frames at rest do not count. */
  private adapt(asked: View, view: View, milliseconds: number, stage: Stage): void {
    if (stage !== 'moving') {
      return;
    }
    const used = asked.camera.size[1] / view.camera.size[1];
    const ideal = used * Math.sqrt(MOVING_TIME / Math.max(milliseconds, 1));
    this.factor = Math.min(1, Math.max(COARSEST, used / 2, Math.min(ideal, used * 1.25)));
  }

  private stageAfter(view: View, stage: Stage, milliseconds: number): Stage {
    const isSlow = milliseconds > SAMPLED_WITHIN;
    if (this.wanted !== view) {
      return 'moving';
    }
    if (stage === 'moving' || (stage === 'full' && isSlow && this.isFirst)) {
      // The first frame of a device is slow; only the next one shows whether there is time for supersampling.
      return 'full';
    }
    return stage === 'full' && !isSlow ? 'samples' : 'done';
  }

  private goOn(stage: Stage, next: Stage): void {
    this.isFirst &&= stage !== 'full';
    if (next === 'moving' || next === 'done' || next === stage) {
      this.advance(next);
    } else {
      const rest = stage === 'moving' ? performance.now() - this.changed : 0;
      this.timer = window.setTimeout(() => this.advance(next), Math.max(REST_AFTER - rest, 0));
    }
  }

  /** Renders again after a view was stopped, by a newer view or by a request that the user waits for. */
  private tryAgain(stage: Stage): void {
    if (stage === 'moving') {
      this.factor = Math.max(COARSEST, this.factor / 2);
    }
    if (this.stage === 'moving') {
      this.next();
      return;
    }
    const pauses = Math.min(2 ** this.gaveWay, MOST_PAUSES);
    this.gaveWay += 1;
    this.timer = window.setTimeout(() => this.next(), REST_AFTER * pauses);
  }

  private advance(stage: Stage): void {
    this.stage = stage;
    this.next();
  }
}
