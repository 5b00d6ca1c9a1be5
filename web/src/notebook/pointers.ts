/** Converts gestures on a notebook's picture to steps for the kernel; `npm run notebook` bundles this for Python. */
import type { Pair } from '../core/messages';
import { type Action, actionOfKey } from '../input/bindings';
import { dragOfKey, scrollOfKey, zoomOfKey } from '../input/keys';
import { type Handlers, listen } from '../input/pointer';

/** A name, then numbers; `steps.py` in the kernel performs it. */
export type Step = readonly [string, ...(string | number)[]];

/** A picture with its size (pixels); screen positions are measured from its top left corner. */
export interface Pane {
  readonly element: HTMLElement;
  readonly name: string;
  readonly size: Pair;
  /** Pixels of the picture per pixel of the screen. */
  readonly scale: number;
  pixelOf(at: Pair): Pair;
}

interface Asker {
  ask(step: Step): void;
}

const DRAGS: Partial<Record<Action, string>> = {
  rotate: 'rotate',
  'rotate about vessel': 'spin',
  pan: 'pan',
  window: 'window',
};
const KEYS: Partial<Record<Action, string>> = {
  reset: 'reset',
  silhouettes: 'silhouettes',
  'remove point': 'undo',
  remove: 'undo',
  enter: 'end',
};

/** Handles keys, and gestures of mouse, pen and touch, on a pane. */
export class Pointers {
  constructor(
    readonly pane: Pane,
    private readonly asker: Asker,
  ) {}

  private get isTurning(): boolean {
    return this.pane.name === 'vessels';
  }

  listen(signal: AbortSignal): void {
    const { element } = this.pane;
    // Otherwise the notebook around the picture would handle them too.
    for (const name of ['pointerdown', 'wheel', 'contextmenu']) {
      element.addEventListener(name, (event) => event.stopPropagation(), { signal });
    }
    const focus = (event: Event) => {
      event.preventDefault();
      element.focus({ preventScroll: true });
    };
    element.addEventListener('pointerdown', focus, { signal });
    element.addEventListener('keydown', (event) => this.key(event), { signal });
    signal.addEventListener('abort', listen(element, this.isTurning ? 'turning' : 'flat', this.handlers()));
  }

  private handlers(): Handlers {
    const { pane, asker } = this;
    return {
      drag: (action, by) => this.drag(action, by),
      zoom: (factor, at) => {
        if (this.isTurning) {
          asker.ask(['zoom', factor, ...pane.pixelOf(at)]);
        }
      },
      scroll: (steps) => asker.ask(['scroll', pane.name, steps]),
      click: (action, at) =>
        asker.ask([action === 'pick' ? 'click' : 'double click', pane.name, ...pane.pixelOf(at)]),
      hover: () => undefined,
      begin: () => asker.ask(['begin']),
      end: () => undefined,
      putBack: () => asker.ask(['back']),
    };
  }

  /** Other pictures than the view only change their window; the kernel neither pans nor zooms them. */
  private drag(action: Action, by: Pair): void {
    const step = this.isTurning || action === 'window' ? DRAGS[action] : undefined;
    if (step) {
      this.asker.ask([step, by[0] * this.pane.scale, by[1] * this.pane.scale]);
    }
  }

  private key(event: KeyboardEvent): void {
    const step = this.stepOf(event);
    if (step) {
      event.preventDefault();
      event.stopPropagation();
      this.asker.ask(step);
    }
  }

  /** The step of a key; null for a key that the notebook handles. */
  stepOf(event: KeyboardEvent): Step | null {
    if (event.ctrlKey || event.metaKey || event.altKey) {
      return null;
    }
    return (this.isTurning ? this.turningStep(event) : this.flatStep(event)) ?? commonStep(event.key);
  }

  private turningStep({ key, shiftKey }: KeyboardEvent): Step | null {
    const [by, factor] = [dragOfKey(key), zoomOfKey(key)];
    if (by) {
      return [shiftKey ? 'pan' : 'rotate', ...by];
    }
    return factor === null ? null : ['zoom', factor, ...this.middle()];
  }

  private middle(): Pair {
    const [width, height] = this.pane.size;
    return [(width - 1) / 2, (height - 1) / 2];
  }

  private flatStep({ key }: KeyboardEvent): Step | null {
    const steps = scrollOfKey(key);
    return steps === null ? null : ['scroll', this.pane.name, steps];
  }
}

function commonStep(key: string): Step | null {
  const action = actionOfKey(key);
  if (action?.startsWith('view ')) {
    return ['view', action.slice('view '.length)];
  }
  if (action?.startsWith('preset ')) {
    return ['preset', Number(action.slice('preset '.length))];
  }
  const name = action && KEYS[action];
  return name ? [name] : null;
}
