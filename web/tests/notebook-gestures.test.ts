/** Gestures of the notebook: those of the page, told to the kernel as steps. */
import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import type { Pair } from '../src/core/messages';
import { Pointers, type Step } from '../src/notebook/pointers';

/** A picture of 400 × 200 pixels, shown half as large at (100, 50). */
class Element extends EventTarget {
  focused = 0;
  getBoundingClientRect = () => ({ left: 100, top: 50, width: 200, height: 100 });
  setPointerCapture = () => undefined;
  focus = () => {
    this.focused += 1;
  };
}

let element: Element;
let page: EventTarget;
let steps: Step[] = [];
let pointers: Pointers;
let stop: AbortController;

function begin(name: string) {
  element = new Element();
  stop = new AbortController();
  const pane = {
    element: element as unknown as HTMLElement,
    name,
    size: [400, 200] as const,
    scale: 2,
    pixelOf: ([x, y]: Pair): Pair => [2 * x - 0.5, 2 * y - 0.5],
  };
  pointers = new Pointers(pane, { ask: (step) => steps.push(step) });
  pointers.listen(stop.signal);
}

beforeEach(() => {
  steps = [];
  page = new EventTarget();
  vi.stubGlobal('window', page);
  vi.stubGlobal('WheelEvent', { DOM_DELTA_PIXEL: 0, DOM_DELTA_LINE: 1 });
  begin('vessels');
});

afterEach(() => {
  stop.abort();
  vi.unstubAllGlobals();
});

function send(target: EventTarget, type: string, fields: object): Event {
  const event = new Event(type, { cancelable: true, bubbles: true });
  for (const [name, value] of Object.entries({ pointerId: 1, pointerType: 'mouse', button: 0, ...fields })) {
    Object.defineProperty(event, name, { value });
  }
  target.dispatchEvent(event);
  return event;
}
const pointer = (type: string, [x, y]: Pair, more: object = {}) =>
  send(element, type, { clientX: 100 + x, clientY: 50 + y, ...more });
const wheel = (deltaY: number, more: object = {}) =>
  send(element, 'wheel', { clientX: 140, clientY: 80, deltaY, deltaX: 0, deltaMode: 0, ...more });
const press = (key: string, more: object = {}) => send(element, 'keydown', { key, ...more });

function drag(more: object = {}) {
  pointer('pointerdown', [10, 10], more);
  pointer('pointermove', [13, 10], more);
  pointer('pointermove', [20, 7], more);
  pointer('pointerup', [20, 7], more);
}

describe('drags', () => {
  test.each([
    [{}, 'rotate'],
    [{ altKey: true }, 'spin'],
    [{ shiftKey: true }, 'pan'],
    [{ button: 1 }, 'pan'],
    [{ ctrlKey: true }, 'window'],
    [{ button: 2 }, 'window'],
    [{ pointerType: 'touch' }, 'rotate'],
  ])('with %o is the step %s, in pixels of the picture', (more, name) => {
    drag(more);
    expect(steps).toEqual([['begin'], [name, 20, -6]]);
  });

  test('next to the view only change the window', () => {
    begin('section');
    drag();
    drag({ shiftKey: true });
    drag({ button: 2 });
    expect(steps.filter(([name]) => name !== 'begin')).toEqual([['window', 20, -6]]);
  });

  test('are put back by Escape', () => {
    pointer('pointerdown', [10, 10]);
    pointer('pointermove', [20, 10]);
    send(page, 'keydown', { key: 'Escape' });
    pointer('pointermove', [30, 10]);
    expect(steps).toEqual([['begin'], ['rotate', 20, 0], ['back']]);
  });

  test('stay with the picture, which takes the focus', () => {
    const heard = vi.fn();
    page.addEventListener('pointerdown', heard);
    expect(pointer('pointerdown', [10, 10]).defaultPrevented).toBe(true);
    expect([element.focused, heard.mock.calls.length]).toEqual([1, 0]);
    stop.abort();
    pointer('pointermove', [90, 10]);
    expect(steps).toEqual([]);
  });
});

test('clicks are at pixels of the picture, and the second of two is a double click', () => {
  for (const timeStamp of [1000, 1200]) {
    pointer('pointerdown', [10, 20], { timeStamp });
    pointer('pointerup', [10, 20], { timeStamp });
  }
  expect(steps).toEqual([
    ['click', 'vessels', 19.5, 39.5],
    ['double click', 'vessels', 19.5, 39.5],
  ]);
});

describe('the wheel', () => {
  test('zooms the view at the pointer', () => {
    wheel(-100);
    expect(steps).toEqual([['zoom', Math.exp(0.16), 79.5, 59.5]]);
  });

  test('scrolls what is next to it, by ten with Shift', () => {
    begin('section');
    wheel(100);
    wheel(-240);
    wheel(0, { deltaX: 100, shiftKey: true });
    wheel(50, { ctrlKey: true });
    expect(steps).toEqual([
      ['scroll', 'section', 1],
      ['scroll', 'section', -2],
      ['scroll', 'section', 10],
    ]);
  });
});

describe('keys', () => {
  test.each([
    ['ArrowLeft', {}, ['rotate', -24, 0]],
    ['ArrowDown', { shiftKey: true }, ['pan', 0, 24]],
    ['+', {}, ['zoom', 1.2, 199.5, 99.5]],
    ['p', {}, ['view', 'posterior']],
    ['S', {}, ['view', 'superior']],
    ['3', {}, ['preset', 2]],
    ['r', {}, ['reset']],
    ['s', {}, ['silhouettes']],
    ['Backspace', {}, ['undo']],
    ['Delete', {}, ['undo']],
    ['Enter', {}, ['end']],
  ])('%s with %o', (key, more, step) => {
    expect(press(key, more).defaultPrevented).toBe(true);
    expect(steps).toEqual([step]);
  });

  test.each([
    ['c', {}],
    ['Escape', {}],
    ['z', { ctrlKey: true }],
    ['r', { metaKey: true }],
    ['0', {}],
  ])('%s with %o is left to the notebook', (key, more) => {
    expect(press(key, more).defaultPrevented).toBe(false);
    expect(steps).toEqual([]);
  });

  test('of the pictures next to the view scroll', () => {
    begin('straightened');
    press('ArrowUp');
    press('PageDown');
    press('ArrowLeft');
    press('+');
    expect(steps).toEqual([
      ['scroll', 'straightened', -1],
      ['scroll', 'straightened', 10],
    ]);
  });
});
