/**
 * The loop of the turning view: while something changes, pictures of as many pixels as the rate allows; at rest one with
 * all pixels, and then one with several samples for each. One picture is under way at a time, and the latest view wins.
 */

import type { EngineClient } from '../client/engine';
import { sampled } from '../core/camera';
import { Failure } from '../core/failure';
import type { Drawn, View } from '../core/messages';

/** The time of a picture while something changes (ms): 25 a second leave room for all else. */
const MOVING_TIME = 40;
/** How long nothing changes before the view is at rest (ms). */
const REST_AFTER = 80;
/** So many times that pause at most before a view is tried again that gave way; it doubles with each time. */
const MOST_PAUSES = 16;
/** The fewest pixels along a side while something changes, as a part of all. */
const COARSEST = 0.2;
/** The most pixels of a picture along a pixel of the page, on dense screens. */
const MOST_DENSE = 2;
/** Samples along each side of a pixel at rest, where a picture with one takes at most so long (ms). */
const SAMPLES = 2;
const SAMPLED_WITHIN = 700;

type Stage = 'moving' | 'full' | 'samples' | 'done';

export interface Shown {
  /** What was asked for, before the pixels were made fewer or more. */
  readonly wanted: View;
  readonly view: View;
  readonly drawn: Drawn;
  readonly stage: Stage;
  /** Whether this is the last picture of a view that is still the wanted one. */
  readonly isLast: boolean;
}

export class FrameLoop {
  private wanted: View | null = null;
  private changed = 0;
  private stage: Stage = 'done';
  private isBusy = false;
  private isStopped = false;
  /** What draws was exchanged while a picture was under way: that one counts no longer, nor does its failure. */
  private isOutdated = false;
  /** The next picture at rest is the first of a device: its time is also that of compiling shaders. */
  private isFirst = false;
  private factor = 1;
  /** How often in a row the view gave way to something else. */
  private gaveWay = 0;
  private timer = 0;

  constructor(
    private readonly engine: EngineClient,
    private readonly show: (shown: Shown) => void,
    private readonly fail: (failure: Failure) => void,
  ) {}

  /** The view to be shown from now on. */
  want(view: View): void {
    this.wanted = view;
    this.changed = performance.now();
    this.gaveWay = 0;
    if (this.isBusy && (this.stage === 'full' || this.stage === 'samples')) {
      this.engine.stop();
    }
    this.stage = 'moving';
    this.next();
  }

  /** Shows the same view again, after what draws it was exchanged. */
  again(): void {
    if (this.isBusy) {
      this.isOutdated = true;
    } else if (this.wanted) {
      // From the start, since the first pictures of a device also take the time that its shaders need to be compiled.
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
      const drawn = await this.engine.render(asked);
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

  /** Draws the view again where what draws was exchanged meanwhile; says whether it was. */
  private beginsAnew(): boolean {
    const isOutdated = this.isOutdated;
    this.isOutdated = false;
    if (isOutdated) {
      this.again();
    }
    return isOutdated;
  }

  /** The view with the pixels and samples of a stage. */
  private atStage(view: View, stage: Stage): View {
    if (stage === 'moving') {
      const settings = { ...view.settings, context_preview: true, samples: 1 };
      return { ...view, camera: sampled(view.camera, this.factor), settings };
    }
    const camera = sampled(view.camera, Math.min(window.devicePixelRatio || 1, MOST_DENSE));
    return stage === 'samples'
      ? { ...view, camera, settings: { ...view.settings, samples: SAMPLES } }
      : { ...view, camera };
  }

  /**
   * As many pixels as take the wanted time, judged by the picture before; by no more than a half at once. Pictures at rest
   * say nothing of it: they take longer, and what was learnt before stays for the next change.
   */
  private adapt(asked: View, view: View, milliseconds: number, stage: Stage): void {
    if (stage !== 'moving') {
      return;
    }
    const used = asked.camera.size[1] / view.camera.size[1];
    const ideal = used * Math.sqrt(MOVING_TIME / Math.max(milliseconds, 1));
    this.factor = Math.min(1, Math.max(COARSEST, used / 2, Math.min(ideal, used * 1.25)));
  }

  /** The stage of the picture that follows one of this stage and time. */
  private stageAfter(view: View, stage: Stage, milliseconds: number): Stage {
    const isSlow = milliseconds > SAMPLED_WITHIN;
    if (this.wanted !== view) {
      return 'moving';
    }
    if (stage === 'moving' || (stage === 'full' && isSlow && this.isFirst)) {
      // After the first picture of a device only the next one tells whether there is time for samples.
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

  /** After a view was stopped: by a newer one, or by something that the user waits for. */
  private tryAgain(stage: Stage): void {
    if (stage === 'moving') {
      // It took too long: the next one has fewer pixels.
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
