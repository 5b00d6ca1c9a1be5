/** Converts wheel movements to steps: one per notch of a mouse wheel; small trackpad movements are summed. */

/** A wheel event of at least this many pixels is a notch of a mouse (100 to 120); a trackpad sends far less. */
const NOTCH_FROM = 60;
const NOTCH = 110;
const NOTCH_LINES = 3;
/** Pixels that a trackpad or finger moves per step. */
const STEP = 40;

export class Steps {
  private rest = 0;

  /** The number of complete steps of a wheel event; the remainder is kept for the next event. */
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

/** The movement of the wheel; with Shift, browsers report it as horizontal. */
export const alongWheel = ({ deltaX, deltaY, shiftKey }: WheelEvent): number =>
  shiftKey && deltaY === 0 ? deltaX : deltaY;
