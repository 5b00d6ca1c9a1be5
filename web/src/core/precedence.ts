/** Answers take precedence over views: they stop the current view, which restarts afterwards. */

/** How long an answer waits for a moving view, which usually finishes soon (ms). */
const PATIENCE = 60;
/** After this many stopped views in a row the next one runs to completion. */
const MOST_STOPS = 6;

interface UnderWay {
  /** Whether the view only adds pixels or samples to the picture. */
  readonly isRefining: boolean;
  isStopped: boolean;
}

export class Precedence {
  private underWay: UnderWay | null = null;
  private stops = 0;

  constructor(private readonly stop: () => void) {}

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

  /** Registers an answer that the user waits for; views yield to it. */
  async first<T>(answer: Promise<T>): Promise<T> {
    const view = this.underWay;
    if (!view || this.stops >= MOST_STOPS) {
      return answer;
    }
    // Repeated, because a view ignores a stop before it begins.
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
