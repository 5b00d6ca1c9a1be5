/**
 * What the user waits for comes before views: the worker does one piece of work after the other, so the view under way is
 * stopped and asked for again afterwards. One that was stopped again and again runs to its end.
 */

/** How long an answer waits for a view of something that changes, which is quick as a rule (ms). */
const PATIENCE = 60;
/** So many views in a row are stopped; the next one is not. */
const MOST_STOPS = 6;

interface UnderWay {
  /** Whether the view only adds pixels or samples to what is shown already. */
  readonly isRefining: boolean;
  isStopped: boolean;
}

export class Precedence {
  private underWay: UnderWay | null = null;
  private stops = 0;

  constructor(
    /** Stops the view under way, where that is possible. */
    private readonly stop: () => void,
  ) {}

  /** Hears of a view that was asked for, to its end. */
  async view<T>(isRefining: boolean, drawn: Promise<T>): Promise<T> {
    const own: UnderWay = { isRefining, isStopped: false };
    this.underWay = own;
    try {
      const picture = await drawn;
      this.stops = 0;
      return picture;
    } finally {
      if (this.underWay === own) {
        this.underWay = null;
      }
    }
  }

  /** Hears an answer that the user waits for, and has a view give way to it. */
  async first<T>(answer: Promise<T>): Promise<T> {
    const view = this.underWay;
    if (!view || this.stops >= MOST_STOPS) {
      return answer;
    }
    // Asked more than once: a view hears nothing before it begins.
    const timer = setInterval(() => this.giveWay(view), PATIENCE);
    if (view.isRefining && !view.isStopped) {
      this.giveWay(view);
    }
    try {
      return await answer;
    } finally {
      clearInterval(timer);
    }
  }

  private giveWay(view: UnderWay): void {
    if (this.underWay !== view) {
      return;
    }
    if (!view.isStopped) {
      view.isStopped = true;
      this.stops += 1;
    }
    this.stop();
  }
}
