// Mouse, pen, touch and keys on a picture: the steps that they ask for, as in the viewer.

/** How far a press moves before it is a drag, how a double click is told from two, what the wheel zooms by. */
const DRAG_FROM = 4;
const DOUBLE_WITHIN = 350;
const DOUBLE_NEAR = 6;
const ZOOM_PER_WHEEL = 0.0016;
const MOST_WHEEL = 120;
const LINE = 40;
/** From here on (pixels) one event is notches of a mouse; trackpads tell far fewer at a time. */
const NOTCH_FROM = 60;
const NOTCH = 110;
const KEY_STEP = 24;
const VIEW_OF_KEY = { a: 'anterior', p: 'posterior', l: 'left', R: 'right', S: 'superior', I: 'inferior' };
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const STEP_OF_KEY = { r: 'reset', s: 'silhouettes', Backspace: 'undo', Delete: 'undo', Enter: 'end' };

/** Presses, drags and clicks of mouse, pen and touch on a pane. */
class Pointers {
  constructor(pane, asker) {
    this.pane = pane;
    this.asker = asker;
    this.held = new Map();
    this.action = null;
    this.isDragging = false;
    this.lastClick = { time: Number.NEGATIVE_INFINITY, at: [0, 0] };
    this.rest = 0;
  }

  listen(signal) {
    const on = (name, act, options = {}) =>
      this.pane.element.addEventListener(name, (event) => act.call(this, event), { signal, ...options });
    on('pointerdown', this.down);
    on('pointermove', this.move);
    on('pointerup', this.up);
    on('pointercancel', this.cancel);
    on('wheel', this.wheel, { passive: false });
    on('keydown', this.key);
    on('contextmenu', (event) => {
      event.preventDefault();
      event.stopPropagation();
    });
  }

  down(event) {
    event.preventDefault();
    event.stopPropagation();
    this.pane.element.focus({ preventScroll: true });
    this.pane.element.setPointerCapture(event.pointerId);
    this.held.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.held.size > 1) {
      this.begin();
      this.spread = this.distance();
      return;
    }
    this.isDragging = false;
    this.start = [event.clientX, event.clientY];
    this.action = actionOf(event, this.pane.name);
    this.isClick = event.button === 0;
  }

  distance() {
    const [a, b] = [...this.held.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  }

  begin() {
    if (!this.isDragging) {
      this.isDragging = true;
      this.asker.ask(['begin']);
    }
  }

  move(event) {
    const before = this.held.get(event.pointerId);
    if (!before) {
      return;
    }
    const [x, y] = [event.clientX, event.clientY];
    if (!this.isDragging && Math.hypot(x - this.start[0], y - this.start[1]) <= DRAG_FROM) {
      return;
    }
    this.begin();
    this.held.set(event.pointerId, [x, y]);
    const by = [x - before[0], y - before[1]].map((part) => part * this.pane.scale);
    if (this.held.size > 1) {
      this.moveTwo(event, by);
    } else if (this.action) {
      this.asker.ask([this.action, ...by]);
    }
  }

  moveTwo(event, by) {
    if (this.pane.name !== 'vessels') {
      return;
    }
    const spread = this.distance();
    if (this.spread > 0 && spread > 0) {
      this.asker.ask(['zoom', spread / this.spread, ...this.pane.pixelOf(event)]);
    }
    this.spread = spread;
    this.asker.ask(['pan', by[0] / 2, by[1] / 2]);
  }

  up(event) {
    if (!this.held.delete(event.pointerId) || this.held.size > 0) {
      return;
    }
    if (this.isDragging) {
      this.isDragging = false;
    } else if (this.isClick) {
      this.click(event);
    }
  }

  click(event) {
    const [at, last] = [[event.clientX, event.clientY], this.lastClick];
    const isNear = Math.hypot(at[0] - last.at[0], at[1] - last.at[1]) <= DOUBLE_NEAR;
    const isDouble = event.timeStamp - last.time < DOUBLE_WITHIN && isNear;
    this.lastClick = { time: isDouble ? Number.NEGATIVE_INFINITY : event.timeStamp, at };
    this.asker.ask([isDouble ? 'double click' : 'click', this.pane.name, ...this.pane.pixelOf(event)]);
  }

  cancel(event) {
    this.held.delete(event.pointerId);
    this.isDragging = this.isDragging && this.held.size > 0;
  }

  wheel(event) {
    event.preventDefault();
    event.stopPropagation();
    const along = event.shiftKey && event.deltaY === 0 ? event.deltaX : event.deltaY;
    const pixels = along * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1);
    if (this.pane.name === 'vessels') {
      const bounded = Math.max(-MOST_WHEEL, Math.min(MOST_WHEEL, pixels));
      this.asker.ask(['zoom', Math.exp(-bounded * ZOOM_PER_WHEEL), ...this.pane.pixelOf(event)]);
      return;
    }
    const notches = this.notchesOf(pixels);
    if (notches !== 0) {
      this.asker.ask(['scroll', this.pane.name, notches * (event.shiftKey ? 10 : 1)]);
    }
  }

  /** Whole notches of a mouse; the small movements of a trackpad add up to them. */
  notchesOf(pixels) {
    if (Math.abs(pixels) >= NOTCH_FROM) {
      this.rest = 0;
      return Math.sign(pixels) * Math.max(1, Math.round(Math.abs(pixels) / NOTCH));
    }
    this.rest += pixels / LINE;
    const notches = Math.trunc(this.rest);
    this.rest -= notches;
    return notches;
  }

  key(event) {
    const steps = this.stepsOf(event);
    if (steps) {
      event.preventDefault();
      event.stopPropagation();
      if (event.key === 'Escape') {
        this.held.clear();
        this.isDragging = false;
      }
      for (const step of steps) {
        this.asker.ask(step);
      }
    }
  }

  stepsOf({ key, shiftKey, ctrlKey, metaKey, altKey }) {
    const arrow = ARROWS[key];
    if (ctrlKey || metaKey || altKey) {
      return null;
    } else if (key === 'Escape' && this.isDragging) {
      return [['back']];
    } else if (arrow && this.pane.name === 'vessels') {
      return [[shiftKey ? 'pan' : 'rotate', arrow[0] * KEY_STEP, arrow[1] * KEY_STEP]];
    } else if (arrow && arrow[1] !== 0) {
      return [['scroll', this.pane.name, arrow[1]]];
    } else if ((key === '+' || key === '-') && this.pane.name === 'vessels') {
      const [width, height] = this.pane.size;
      return [['zoom', key === '+' ? 1.2 : 1 / 1.2, (width - 1) / 2, (height - 1) / 2]];
    } else if (key in VIEW_OF_KEY) {
      return [['view', VIEW_OF_KEY[key]]];
    } else if (key >= '1' && key <= '8' && key.length === 1) {
      return [['preset', Number(key) - 1]];
    }
    return key in STEP_OF_KEY ? [[STEP_OF_KEY[key]]] : null;
  }
}

/** What a drag does, by button and modifier, as in the viewer. */
function actionOf(event, pane) {
  const isWindow = event.button === 2 || (event.button === 0 && (event.ctrlKey || event.metaKey));
  if (pane !== 'vessels' || isWindow) {
    return isWindow ? 'window' : null;
  }
  return event.button === 1 || event.shiftKey ? 'pan' : event.altKey ? 'spin' : 'rotate';
}
