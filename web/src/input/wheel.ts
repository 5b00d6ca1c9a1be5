/** Converts wheel movements to zooms, and to steps: one per mouse notch; trackpad movements add up. */
import { GESTURES } from '../core/generated/tables';

export class Steps {
  private rest = 0;

  /** The number of complete steps of a wheel event; the remainder is kept for the next event. */
  ofWheel(event: WheelEvent): number {
    const by = alongWheel(event);
    const isInPixels = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL;
    if (isInPixels && Math.abs(by) < GESTURES.notch_from) {
      return this.ofPixels(by);
    }
    this.rest = 0;
    const notches = Math.abs(by) / (isInPixels ? GESTURES.notch : GESTURES.notch_lines);
    return Math.sign(by) * Math.max(1, Math.round(notches));
  }

  ofPixels(pixels: number): number {
    this.rest += pixels;
    const steps = Math.trunc(this.rest / GESTURES.scroll_step);
    this.rest -= steps * GESTURES.scroll_step;
    return steps;
  }
}

/** The movement of the wheel; with Shift, browsers report it as horizontal. */
export const alongWheel = ({ deltaX, deltaY, shiftKey }: WheelEvent): number =>
  shiftKey && deltaY === 0 ? deltaX : deltaY;

/** Zoom of a wheel event; trackpads send many small ones. */
export function zoomOfWheel(event: WheelEvent): number {
  const { wheel_line: line, most_wheel: most, zoom_per_wheel: part } = GESTURES;
  const pixels = alongWheel(event) * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? line : 1);
  return Math.exp(-Math.max(-most, Math.min(most, pixels)) * part);
}
