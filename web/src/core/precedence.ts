/** Requests that the user waits for take precedence: they stop rendering, which restarts afterwards. */

/** How long a request waits for a view in motion, which usually finishes soon (ms). */
const PATIENCE = 60;
/** After this many views in a row were stopped, the next one runs to completion. */
const MOST_STOPS = 6;

interface UnderWay {
  /** Whether the view only refines a picture that is already displayed. */
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

  /** Waits for an answer, and stops the current view meanwhile. */
  async first<T>(answer: Promise<T>): Promise<T> {
    const view = this.underWay;
    if (!view || this.stops >= MOST_STOPS) {
      return answer;
    }
    // Repeated, because a view that has not begun ignores the stop.
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
