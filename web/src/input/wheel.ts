/** Converts wheel movements to steps: one per mouse notch; trackpad movements add up. */

/** Threshold between mouse and trackpad (pixels): a notch is 100 to 120, a trackpad event far less. */
const NOTCH_FROM = 60;
const NOTCH = 110;
const NOTCH_LINES = 3;
/** Pixels of a trackpad or finger per step. */
const STEP = 40;

export class Steps {
  private rest = 0;

  /** Whole steps of a wheel event; the remainder is kept. */
  ofWheel(event: WheelEvent): number {
    const by = alongWheel(event);
    const isInPixels = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL;
    if (isInPixels && Math.abs(by) < NOTCH_FROM) {
      return this.ofPixels(by);
    }
    this.rest = 0;
    const notches = Math.abs(by) / (isInPixels ? NOTCH : NOTCH_LINES);
    return Math.sign(by) * Math.max(1, Math.round(notches));
  }

  ofPixels(pixels: number): number {
    this.rest += pixels;
    const steps = Math.trunc(this.rest / STEP);
    this.rest -= steps * STEP;
    return steps;
  }
}

/** With Shift, browsers report horizontal movement. */
export const alongWheel = ({ deltaX, deltaY, shiftKey }: WheelEvent): number =>
  shiftKey && deltaY === 0 ? deltaX : deltaY;
