import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import type { Where } from '../src/input/bindings';
import { type Handlers, listen } from '../src/input/pointer';

/** A fake element at (100, 50) that records which handlers are called. */
class Pane extends EventTarget {
  readonly captured: number[] = [];

  getBoundingClientRect() {
    return { left: 100, top: 50, width: 400, height: 300 };
  }

  setPointerCapture(id: number) {
    this.captured.push(id);
  }
}

let pane: Pane;
let page: EventTarget;
let stop: () => void;
const handlers = {
  drag: vi.fn<Handlers['drag']>(),
  zoom: vi.fn<Handlers['zoom']>(),
  scroll: vi.fn<Handlers['scroll']>(),
  click: vi.fn<Handlers['click']>(),
  hover: vi.fn<Handlers['hover']>(),
  begin: vi.fn<Handlers['begin']>(),
  end: vi.fn<Handlers['end']>(),
  putBack: vi.fn<Handlers['putBack']>(),
  step: vi.fn<NonNullable<Handlers['step']>>(),
  leave: vi.fn<NonNullable<Handlers['leave']>>(),
};

function begin(where: 'turning' | 'flat' = 'turning') {
  stop?.();
  stop = listen(pane as unknown as HTMLElement, where, handlers);
}

beforeEach(() => {
  vi.clearAllMocks();
  page = new EventTarget();
  vi.stubGlobal('window', page);
  vi.stubGlobal('WheelEvent', { DOM_DELTA_PIXEL: 0, DOM_DELTA_LINE: 1 });
  pane = new Pane();
  begin();
});

afterEach(() => {
  stop();
  vi.unstubAllGlobals();
});

function send(type: string, [x, y]: readonly [number, number] = [0, 0], more: object = {}): Event {
  const event = new Event(type, { cancelable: true });
  const fields = {
    pointerId: 1,
    pointerType: 'mouse',
    button: 0,
    clientX: 100 + x,
    clientY: 50 + y,
    ...more,
  };
  for (const [name, value] of Object.entries(fields)) {
    Object.defineProperty(event, name, { value });
  }
  (type === 'keydown' ? page : pane).dispatchEvent(event);
  return event;
}

describe('drag or click', () => {
  test('4 pixels are still a click', () => {
    send('pointerdown', [10, 10]);
    send('pointermove', [14, 10]);
    send('pointerup', [14, 10]);
    expect(handlers.drag).not.toHaveBeenCalled();
    expect(handlers.begin).not.toHaveBeenCalled();
    expect(handlers.click.mock.calls).toEqual([['pick', [14, 10]]]);
  });

  test('more than 4 pixels are a drag, which includes the first 4', () => {
    send('pointerdown', [10, 10]);
    send('pointermove', [13, 10]);
    send('pointermove', [15, 10]);
    send('pointermove', [20, 17]);
    send('pointerup', [20, 17]);
    expect(handlers.click).not.toHaveBeenCalled();
    expect(handlers.begin).toHaveBeenCalledOnce();
    expect(handlers.end).toHaveBeenCalledOnce();
    expect(handlers.drag.mock.calls).toEqual([
      ['rotate', [5, 0], [15, 10]],
      ['rotate', [5, 7], [20, 17]],
    ]);
    expect(pane.captured).toEqual([1]);
  });

  test('a drag that returns to its start is not a click', () => {
    send('pointerdown', [10, 10]);
    send('pointermove', [40, 10]);
    send('pointermove', [10, 10]);
    send('pointerup', [10, 10]);
    expect(handlers.click).not.toHaveBeenCalled();
  });

  test.each([
    [{ altKey: true }, 'rotate about vessel'],
    [{ ctrlKey: true }, 'window'],
    [{ metaKey: true }, 'window'],
    [{ shiftKey: true }, 'pan'],
    [{ button: 1 }, 'pan'],
  ])('%o drags: %s', (more, action) => {
    send('pointerdown', [10, 10], more);
    send('pointermove', [30, 10], more);
    expect(handlers.drag.mock.calls.map(([name]) => name)).toEqual([action]);
  });

  test('the right button changes the window and picks nothing', () => {
    send('pointerdown', [10, 10], { button: 2 });
    send('pointermove', [10, 60], { button: 2 });
    expect(handlers.drag.mock.calls).toEqual([['window', [0, 50], [10, 60]]]);
    send('pointerup', [10, 60], { button: 2 });
    send('pointerdown', [10, 10], { button: 2 });
    send('pointerup', [10, 10], { button: 2 });
    expect(handlers.click).not.toHaveBeenCalled();
  });

  test('the context menu is suppressed', () => {
    expect(send('contextmenu').defaultPrevented).toBe(true);
  });

  test('hovering reports whether Shift is held', () => {
    send('pointermove', [7, 8], { shiftKey: true });
    send('pointermove', [9, 8], { shiftKey: false });
    expect(handlers.hover.mock.calls).toEqual([
      [[7, 8], true],
      [[9, 8], false],
    ]);
  });

  test('events after the end are ignored', () => {
    stop();
    send('pointerdown', [10, 10]);
    send('pointerup', [10, 10]);
    expect(handlers.click).not.toHaveBeenCalled();
  });
});

describe('double click', () => {
  const click = (at: readonly [number, number], timeStamp: number) => {
    send('pointerdown', at, { timeStamp });
    send('pointerup', at, { timeStamp });
  };
  const actions = () => handlers.click.mock.calls.map(([action]) => action);

  test('two quick clicks at one position maximise a view, and a third begins a new double click', () => {
    click([50, 50], 1000);
    click([53, 50], 1300);
    click([53, 50], 1400);
    expect(actions()).toEqual(['pick', 'maximise', 'pick']);
  });

  test('slow clicks and clicks far apart are single clicks', () => {
    click([50, 50], 1000);
    click([50, 50], 1400);
    click([80, 50], 1500);
    expect(actions()).toEqual(['pick', 'pick', 'pick']);
  });
});

describe('touch', () => {
  const finger = (pointerId: number) => ({ pointerId, pointerType: 'touch' });

  test('one finger rotates in the turning view and scrolls slices', () => {
    send('pointerdown', [10, 10], finger(1));
    send('pointermove', [10, 30], finger(1));
    expect(handlers.drag.mock.calls).toEqual([['rotate', [0, 20], [10, 30]]]);
    begin('flat');
    send('pointerdown', [10, 10], finger(1));
    send('pointermove', [10, 60], finger(1));
    expect(handlers.scroll.mock.calls.flat().reduce((a, b) => a + b)).toBe(5);
  });

  test('two fingers pan by their centre and zoom by their distance', () => {
    send('pointerdown', [100, 100], finger(1));
    send('pointerdown', [200, 100], finger(2));
    send('pointermove', [300, 100], finger(2));
    expect(handlers.zoom.mock.calls).toEqual([[2, [200, 100]]]);
    expect(handlers.drag.mock.calls).toEqual([['pan', [50, 0], [200, 100]]]);
    send('pointerup', [300, 100], finger(2));
    send('pointerup', [100, 100], finger(1));
    expect(handlers.begin).toHaveBeenCalledOnce();
    expect(handlers.end).toHaveBeenCalledOnce();
    expect(handlers.click).not.toHaveBeenCalled();
  });

  test('a third finger neither drags nor clicks', () => {
    send('pointerdown', [100, 100], finger(1));
    send('pointerdown', [200, 100], finger(2));
    send('pointerdown', [300, 200], finger(3));
    for (const id of [3, 2, 1]) {
      send('pointerup', [300, 200], finger(id));
    }
    expect(handlers.click).not.toHaveBeenCalled();
    expect(handlers.end).toHaveBeenCalledOnce();
  });

  test('a touch that the browser cancels ends the drag', () => {
    send('pointerdown', [10, 10], finger(1));
    send('pointermove', [10, 30], finger(1));
    send('pointercancel', [10, 30], finger(1));
    expect(handlers.end).toHaveBeenCalledOnce();
  });
});

describe('Escape', () => {
  test('undoes a drag and has no further effect', () => {
    send('pointerdown', [10, 10]);
    send('pointermove', [60, 10]);
    const event = send('keydown', [0, 0], { key: 'Escape' });
    expect(handlers.putBack).toHaveBeenCalledOnce();
    expect(event.defaultPrevented).toBe(true);
    send('pointermove', [90, 10]);
    send('pointerup', [90, 10]);
    expect(handlers.drag).toHaveBeenCalledOnce();
    expect(handlers.click).not.toHaveBeenCalled();
  });

  test('is handled by the page if nothing is dragged', () => {
    expect(send('keydown', [0, 0], { key: 'Escape' }).defaultPrevented).toBe(false);
    expect(handlers.putBack).not.toHaveBeenCalled();
  });
});

describe('wheel', () => {
  const wheel = (deltaY: number, more: object = {}) =>
    send('wheel', [40, 30], { deltaY, deltaMode: 0, ctrlKey: false, metaKey: false, ...more });

  test('zooms at the pointer: up is closer, in small steps for a trackpad', () => {
    expect(wheel(-100).defaultPrevented).toBe(true);
    wheel(2);
    wheel(100_000);
    const [[near], [trackpad], [far]] = handlers.zoom.mock.calls as unknown as [[number], [number], [number]];
    expect(near).toBeGreaterThan(1.1);
    expect(trackpad).toBeGreaterThan(0.99);
    expect(far).toBeGreaterThan(0.8);
    expect(handlers.zoom.mock.calls[0]?.[1]).toEqual([40, 30]);
  });

  test('with Alt steps through the objects under the pointer, if the tool has this binding', () => {
    Object.assign(handlers, { rows: () => 'tracing' });
    wheel(100, { altKey: true });
    expect([handlers.step.mock.calls, handlers.zoom.mock.calls]).toEqual([[[1]], []]);
    expect(handlers.leave).not.toHaveBeenCalled();
    // Turning or zooming changes the content under the pointer.
    wheel(100);
    expect([handlers.zoom.mock.calls.length, handlers.leave.mock.calls.length]).toEqual([1, 1]);
    Object.assign(handlers, { rows: undefined });
  });

  test('scrolls one slice per notch of a mouse, in all browsers', () => {
    begin('flat');
    wheel(100);
    wheel(-120);
    wheel(3, { deltaMode: 1 });
    wheel(-1, { deltaMode: 1 });
    expect(handlers.scroll.mock.calls.flat()).toEqual([1, -1, 1, -1]);
  });

  test('scrolls as many slices as notches arrive together', () => {
    begin('flat');
    wheel(200);
    wheel(-240);
    wheel(360);
    wheel(-9, { deltaMode: 1 });
    expect(handlers.scroll.mock.calls.flat()).toEqual([2, -2, 3, -3]);
  });

  test('with Shift scrolls ten slices per notch, also if reported as horizontal', () => {
    begin('flat');
    wheel(100, { shiftKey: true });
    wheel(0, { deltaX: -120, shiftKey: true });
    wheel(0, { deltaX: -120 });
    expect(handlers.scroll.mock.calls.flat()).toEqual([10, -10]);
  });

  test('of a trackpad sums small movements to slices; with Ctrl it zooms', () => {
    begin('flat');
    wheel(30);
    expect(handlers.scroll).not.toHaveBeenCalled();
    wheel(30);
    wheel(-50);
    wheel(-30);
    expect(handlers.scroll.mock.calls.flat()).toEqual([1, -1]);
    wheel(-50, { ctrlKey: true });
    expect(handlers.zoom).toHaveBeenCalledOnce();
  });
});

describe('while a tool is active', () => {
  let rows: Where | null = 'tracing';
  const withTool = { ...handlers, rows: () => rows };

  beforeEach(() => {
    rows = 'tracing';
    stop();
    stop = listen(pane as unknown as HTMLElement, 'flat', withTool);
  });

  const click = (button: number, timeStamp: number) => {
    send('pointerdown', [10, 10], { button, timeStamp });
    send('pointerup', [10, 10], { button, timeStamp });
  };

  test('a click sets a point, a second one at the same position ends the vessel', () => {
    click(0, 100);
    click(0, 200);
    expect(handlers.click.mock.calls.map(([action]) => action)).toEqual(['set point', 'end vessel']);
  });

  test('a right click adds a point on a curve, and two of them are not a double click', () => {
    click(2, 100);
    click(2, 200);
    expect(handlers.click.mock.calls.map(([action]) => action)).toEqual(['add point', 'add point']);
  });

  test('a drag acts as in the view', () => {
    send('pointerdown', [10, 10]);
    send('pointermove', [30, 10]);
    send('pointerup', [30, 10]);
    expect(handlers.drag.mock.calls.map(([action]) => action)).toEqual(['pan']);
    expect(handlers.click).not.toHaveBeenCalled();
  });

  test('afterwards clicks act as in the view, and a right click does nothing', () => {
    rows = null;
    click(0, 100);
    click(2, 900);
    expect(handlers.click.mock.calls.map(([action]) => action)).toEqual(['pick']);
  });
});
