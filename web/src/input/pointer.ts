/** Gestures of mouse, wheel, pen and touch. A press becomes a drag after some pixels; otherwise it is a click. */
import { GESTURES } from '../core/generated/tables';
import { type Action, actionOf, type Button, type Modifier, type Where } from './bindings';

/** Handlers of a view; positions are CSS pixels from its top left. */
export interface Handlers {
  drag(action: Action, by: readonly [number, number], at: readonly [number, number]): void;
  zoom(factor: number, at: readonly [number, number]): void;
  scroll(steps: number): void;
  click(action: Action, at: readonly [number, number]): void;
  hover(at: readonly [number, number], shift: boolean): void;
  begin(): void;
  end(): void;
  /** The table of bindings that takes precedence over the table of the view; null if none. */
  rows?(): Where | null;
  /** Called to step through objects that lie behind each other under the pointer. */
  step?(by: number): void;
  /** Called when the pointer left the view, or the content under it changed. */
  leave?(): void;
  /** Called on Escape during a drag; restores the state from before the drag. */
  putBack(): void;
}

type Pixel = [number, number];

export function listen(element: HTMLElement, where: Where, handlers: Handlers): () => void {
  const gestures = new Pointers(element, where, handlers);
  const stop = new AbortController();
  const options = { signal: stop.signal };
  element.addEventListener('pointerdown', (event) => gestures.down(event), options);
  element.addEventListener('pointermove', (event) => gestures.move(event), options);
  element.addEventListener('pointerup', (event) => gestures.up(event), options);
  element.addEventListener('pointercancel', (event) => gestures.cancel(event), options);
  element.addEventListener('pointerleave', () => handlers.leave?.(), options);
  element.addEventListener('wheel', (event) => gestures.wheel(event), {
    passive: false,
    signal: stop.signal,
  });
  window.addEventListener('keydown', (event) => gestures.key(event), { capture: true, signal: stop.signal });
  element.addEventListener('contextmenu', (event) => event.preventDefault(), options);
  return () => stop.abort();
}

const BUTTONS: readonly Button[] = ['left', 'middle', 'right'];

function modifierOf(event: MouseEvent): Modifier {
  return event.altKey ? 'Alt' : event.ctrlKey || event.metaKey ? 'Ctrl' : event.shiftKey ? 'Shift' : '';
}

class Pointers {
  private readonly held = new Map<number, Pixel>();
  private start: Pixel = [0, 0];
  private action: Action | null = null;
  private clickAction: Action | null = null;
  private isDragging = false;
  private spread = 0;
  private readonly steps = new Steps();
  private lastClick = { time: Number.NEGATIVE_INFINITY, at: [0, 0] as Pixel };

  constructor(
    private readonly element: HTMLElement,
    private readonly where: Where,
    private readonly handlers: Handlers,
  ) {}

  private placeOf(event: MouseEvent): Pixel {
    const box = this.element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  down(event: PointerEvent): void {
    if ((event.target as Partial<Element> | null)?.closest?.('button, input, select')) {
      return;
    }
    const at = this.placeOf(event);
    this.held.set(event.pointerId, at);
    this.element.setPointerCapture(event.pointerId);
    if (event.button === 1) {
      event.preventDefault();
    }
    if (this.held.size > 1) {
      // A third finger is ignored.
      this.beginTwo();
      return;
    }
    this.start = at;
    this.isDragging = false;
    const isTouch = event.pointerType === 'touch';
    const button = BUTTONS[event.button] ?? 'left';
    this.action = isTouch
      ? actionOf(this.where, 'touch drag', null, '')
      : actionOf(this.where, 'drag', button, modifierOf(event));
    this.clickAction = this.clickedWith('click', button === 'left' ? null : button);
  }

  private clickedWith(gesture: 'click' | 'double click', button: Button | null): Action | null {
    const rows = this.handlers.rows?.() ?? null;
    const own = rows && actionOf(rows, gesture, button, '');
    return own ?? actionOf(this.where, gesture, button, '');
  }

  private beginTwo(): void {
    this.spread = this.distance();
    if (!this.isDragging) {
      this.handlers.begin();
    }
    this.isDragging = true;
    this.clickAction = null;
  }

  private distance(): number {
    const [a, b] = [...this.held.values()];
    return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }

  move(event: PointerEvent): void {
    const at = this.placeOf(event);
    const before = this.held.get(event.pointerId);
    if (!before) {
      this.handlers.hover(at, event.shiftKey);
      return;
    }
    const by: Pixel = [at[0] - before[0], at[1] - before[1]];
    if (this.held.size > 1) {
      this.held.set(event.pointerId, at);
      this.moveTwo(by);
      return;
    }
    if (!this.isDragging && Math.hypot(at[0] - this.start[0], at[1] - this.start[1]) <= GESTURES.drag_from) {
      return;
    }
    if (!this.isDragging) {
      this.isDragging = true;
      this.handlers.leave?.();
      this.handlers.begin();
    }
    this.held.set(event.pointerId, at);
    this.dragged(by, at);
  }

  private moveTwo(by: Pixel): void {
    const middle = this.middle();
    const spread = this.distance();
    if (this.spread > 0 && spread > 0) {
      this.handlers.zoom(spread / this.spread, middle);
    }
    this.spread = spread;
    this.handlers.drag('pan', [by[0] / 2, by[1] / 2], middle);
  }

  private middle(): Pixel {
    const [a, b] = [...this.held.values()];
    return a && b ? [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] : this.start;
  }

  private dragged(by: Pixel, at: Pixel): void {
    if (this.action === 'scroll') {
      this.scrollBy(this.steps.ofPixels(by[1] * GESTURES.finger_gain));
    } else if (this.action) {
      this.handlers.drag(this.action, by, at);
    }
  }

  up(event: PointerEvent): void {
    if (!this.held.delete(event.pointerId)) {
      return;
    }
    if (this.isDragging) {
      if (this.held.size === 0) {
        this.isDragging = false;
        this.handlers.end();
      }
      return;
    }
    if (this.clickAction) {
      this.click(this.placeOf(event), event);
    }
  }

  private click(at: Pixel, { timeStamp: time, button }: PointerEvent): void {
    const last = this.lastClick;
    const isNear = Math.hypot(at[0] - last.at[0], at[1] - last.at[1]) <= GESTURES.double_near;
    if (time - last.time < GESTURES.double_within && isNear && button === 0) {
      this.lastClick = { time: Number.NEGATIVE_INFINITY, at };
      const action = this.clickedWith('double click', null);
      if (action) {
        this.handlers.click(action, at);
      }
      return;
    }
    this.lastClick = { time, at };
    if (this.clickAction) {
      this.handlers.click(this.clickAction, at);
    }
  }

  cancel(event: PointerEvent): void {
    this.held.delete(event.pointerId);
    if (this.isDragging && this.held.size === 0) {
      this.isDragging = false;
      this.handlers.end();
    }
  }

  key(event: KeyboardEvent): void {
    if (event.key === 'Escape' && this.isDragging) {
      event.stopPropagation();
      event.preventDefault();
      this.held.clear();
      this.isDragging = false;
      this.handlers.putBack();
    }
  }

  wheel(event: WheelEvent): void {
    event.preventDefault();
    // Browsers report a pinch on a trackpad as a wheel event with Ctrl.
    const rows = this.handlers.rows?.() ?? null;
    const modifier = modifierOf(event);
    const action =
      (rows && actionOf(rows, 'wheel', null, modifier)) ?? actionOf(this.where, 'wheel', null, modifier);
    if (action === 'step') {
      this.handlers.step?.(this.steps.ofWheel(event));
      return;
    }
    this.handlers.leave?.();
    if (action === 'zoom') {
      this.handlers.zoom(zoomOfWheel(event), this.placeOf(event));
    } else if (action === 'scroll' || action === 'scroll by ten') {
      this.scrollBy(this.steps.ofWheel(event) * (action === 'scroll' ? 1 : GESTURES.far_steps));
    }
  }

  private scrollBy(steps: number): void {
    if (steps !== 0) {
      this.handlers.scroll(steps);
    }
  }
}

/** Converts wheel movements to steps: one per mouse notch; trackpad movements add up. */
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
const alongWheel = ({ deltaX, deltaY, shiftKey }: WheelEvent): number =>
  shiftKey && deltaY === 0 ? deltaX : deltaY;

/** Zoom of a wheel event; trackpads send many small ones. */
function zoomOfWheel(event: WheelEvent): number {
  const { wheel_line: line, most_wheel: most, zoom_per_wheel: part } = GESTURES;
  const pixels = alongWheel(event) * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? line : 1);
  return Math.exp(-Math.max(-most, Math.min(most, pixels)) * part);
}
