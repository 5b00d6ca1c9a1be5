/** How many steps a wheel goes: a notch of a mouse is one step, and the small movements of a trackpad add up to steps. */

/** From here on (pixels) one event is notches of a mouse: browsers tell 100 to 120 pixels for each, trackpads far fewer at a time. */
const NOTCH_FROM = 60;
const NOTCH = 110;
/** The lines of one notch, in browsers that count lines. */
const NOTCH_LINES = 3;
/** The pixels of a trackpad, or of a finger, that are one step. */
const STEP = 40;

export class Steps {
  private rest = 0;

  /** Whole steps of an event of the wheel; what is left of smaller movements is kept for the next. */
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

  /** Whole steps of a movement in pixels. */
  ofPixels(pixels: number): number {
    this.rest += pixels;
    const steps = Math.trunc(this.rest / STEP);
    this.rest -= steps * STEP;
    return steps;
  }
}

/** With Shift browsers tell the wheel as one across. */
export const alongWheel = ({ deltaX, deltaY, shiftKey }: WheelEvent): number =>
  shiftKey && deltaY === 0 ? deltaX : deltaY;
