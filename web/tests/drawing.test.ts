import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Vector } from '../src/core/messages';
import {
  acceptCandidate,
  endVessel,
  enter,
  leave,
  removeLast,
  setPoint,
  takeWhole,
} from '../src/edit/pointing';
import { followPointer } from '../src/edit/previews';
import { anchor, candidate, coming, dragged, drawn, first, livePaths, target } from '../src/state/drawing';
import { document_, undo } from '../src/state/history';
import { beginStudy } from '../src/state/shown';
import * as store from '../src/state/store';
import { active, tool } from '../src/state/tool';
import { connect } from '../src/worker/engine';
import { documentOf, FakeTracing, FLOOR } from './fake-tracing';

const A: Vector = [0, 0, 0];
const B: Vector = [10, 0, 0];
const C: Vector = [20, 5, 0];

let tracing: FakeTracing;
let end: () => void;
const idle = () => new Promise((resolve) => setTimeout(resolve, 5));
const clicks = () => document_.value.vessels.map((vessel) => vessel.clicks);

beforeEach(() => {
  tracing = new FakeTracing();
  connect(tracing);
  beginStudy(documentOf());
  tool.value = 'trace';
  endVessel();
  end = followPointer();
});

afterEach(() => {
  end();
  tool.value = 'look';
});

const hairAt = (point: Vector) => {
  store.crossHair.value = { point, value: null, vessel: null, arcLength: null };
};

describe('points', () => {
  test('the second begins a vessel, further ones extend it, and after its end another begins', async () => {
    await setPoint(A);
    expect(first.value).toEqual(A);
    expect(clicks()).toEqual([]);
    await setPoint(B);
    await setPoint(C);
    expect(clicks()).toEqual([[A, B, C]]);
    endVessel();
    await setPoint(C);
    await setPoint(A);
    expect(clicks()).toEqual([
      [A, B, C],
      [C, A],
    ]);
  });

  test('that are set while the first two are traced belong to the same vessel', async () => {
    await Promise.all([setPoint(A), setPoint(B), setPoint(C)]);
    expect(clicks()).toEqual([[A, B, C]]);
    expect(drawn.value?.clicks).toHaveLength(3);
  });

  test('a vessel that was ended while it was traced is not extended', async () => {
    await setPoint(A);
    const setting = setPoint(B);
    endVessel();
    await setting;
    expect(active.value).toBeNull();
    expect(anchor.value).toBeNull();
  });

  describe('that are still being traced', () => {
    let open: () => void;
    beforeEach(async () => {
      tracing.gate = new Promise((resolve) => {
        open = resolve;
      });
      await setPoint(A);
      hairAt(B);
    });

    const layDown = () => {
      tool.value = 'look';
      endVessel();
    };

    test.each([
      ['Enter', () => enter()],
      ['Done and t', layDown],
    ])('are finished after %s, and the next point is of another vessel', async (_, end) => {
      const setting = [setPoint(B), setPoint(C)];
      hairAt(C);
      end();
      expect(anchor.value).toBeNull();
      expect(coming.value).toHaveLength(2);
      tool.value = 'trace';
      setting.push(setPoint([1, 2, 3]), setPoint([4, 5, 6]));
      open();
      await Promise.all(setting);
      expect(clicks()).toEqual([
        [A, B, C],
        [
          [1, 2, 3],
          [4, 5, 6],
        ],
      ]);
      expect(coming.value).toEqual([]);
      expect(drawn.value?.clicks?.[0]).toEqual([1, 2, 3]);
    });

    test('are reported if they are rejected after the vessel was ended', async () => {
      const setting = setPoint([0, 0, FLOOR - 1]);
      layDown();
      open();
      await setting;
      expect(clicks()).toEqual([]);
      expect(store.problem.value?.found).toBe('no lumen');
    });
  });

  test('the first is rejected at once if no vessel can begin there; the next one clears the message', async () => {
    const found = () => store.problem.value?.found ?? 'nothing wrong';
    const fat: Vector = [0, 0, FLOOR - 1];
    const setting = setPoint(fat);
    expect(first.value).toEqual(fat);
    await setting;
    expect(first.value).toBeNull();
    expect(found()).toBe('fat');
    expect(store.crossHair.value?.point).toEqual(fat);
    await setPoint(A);
    expect(first.value).toEqual(A);
    expect(found()).toBe('nothing wrong');
  });

  test('a rejected second point keeps the first', async () => {
    await setPoint(A);
    await setPoint([0, 0, FLOOR - 1]);
    expect(clicks()).toEqual([]);
    expect(anchor.value).toEqual(A);
    await setPoint(B);
    expect(clicks()).toEqual([[A, B]]);
  });

  describe('a bad first point', () => {
    test('is the one that is refused, and the good second one takes its place', async () => {
      const air: Vector = [9, 9, FLOOR - 1];
      first.value = air;
      await setPoint(A);
      expect(clicks()).toEqual([]);
      expect(anchor.value).toEqual(A);
      expect(store.crossHair.value?.point).toEqual(A);
      await setPoint(B);
      expect(clicks()).toEqual([[A, B]]);
    });

    test('without a whole vessel gives way to the next one, though nothing blames it', async () => {
      const edit = tracing.edit.bind(tracing);
      tracing.edit = (request) =>
        request.edit.kind === 'add_whole_vessel' || request.edit.kind === 'begin_vessel'
          ? Promise.reject(new Failure('tracing', 'this point', 'no vessel', 'one', 'click a second point'))
          : edit(request);
      await setPoint(C);
      expect(takeWhole()).toBe(true);
      await idle();
      expect(anchor.value, 'a second point could help').toEqual(C);
      await setPoint(A);
      expect(anchor.value).toEqual(A);
      await setPoint(B);
      expect(anchor.value, 'nothing is known against this one').toEqual(A);
    });
  });

  test('after undo of a vessel, the next point begins another', async () => {
    await setPoint(A);
    await setPoint(B);
    undo();
    await setPoint(C);
    expect(first.value).toEqual(C);
  });

  test('the last one is removed, down to the first', async () => {
    for (const point of [A, B, C]) {
      await setPoint(point);
    }
    removeLast();
    await idle();
    expect(clicks()).toEqual([[A, B]]);
    removeLast();
    await idle();
    expect(clicks()).toEqual([]);
    expect(anchor.value).toEqual(A);
    removeLast();
    expect(anchor.value).toBeNull();
  });

  test('set with the stopper tool are stoppers', async () => {
    tool.value = 'stopper';
    await setPoint(A);
    expect(document_.value.stoppers).toEqual([{ center: A, radius: 3 }]);
  });
});

describe('by keys', () => {
  test('Enter sets points at the cross-hair; twice at one position it ends the vessel', async () => {
    for (const point of [A, B, C]) {
      hairAt(point);
      enter();
      await idle();
    }
    expect(clicks()).toEqual([[A, B, C]]);
    enter();
    expect(active.value).toBeNull();
    expect(clicks()).toEqual([[A, B, C]]);
  });

  test('Enter first confirms a pending point from a projection', async () => {
    hairAt(C);
    candidate.value = A;
    enter();
    expect(first.value).toEqual(A);
    expect(candidate.value).toBeNull();
    expect(acceptCandidate()).toBe(false);
  });

  test('Escape leaves step by step: the pending point, the vessel, the tool', () => {
    first.value = A;
    candidate.value = B;
    expect(leave()).toBe(true);
    expect([candidate.value, first.value]).toEqual([null, A]);
    expect(leave()).toBe(true);
    expect([first.value, tool.value]).toEqual([null, 'trace']);
    expect(leave()).toBe(true);
    expect(tool.value).toBe('look');
    expect(leave()).toBe(false);
  });
});

describe('the path preview', () => {
  test('leads from the last point to the pointer, and ends with the vessel', async () => {
    await setPoint(A);
    target.value = C;
    await idle();
    expect(livePaths.value).toEqual([{ points: [A, [20, 0, 0], C], isFound: true }]);
    endVessel();
    await idle();
    expect(livePaths.value).toEqual([]);
  });

  test('that arrives after the vessel was ended is not shown', async () => {
    await setPoint(A);
    let open = () => {};
    tracing.gate = new Promise((resolve) => {
      open = resolve;
    });
    target.value = C;
    leave();
    const seen: number[] = [];
    const watching = livePaths.subscribe((paths) => seen.push(paths.length));
    open();
    await idle();
    watching();
    expect(Math.max(...seen)).toBe(0);
  });

  test('is straight and marked as missing if none is found', async () => {
    await setPoint(A);
    const far: Vector = [1, 1, FLOOR - 1];
    target.value = far;
    await idle();
    expect(livePaths.value).toEqual([{ points: [A, far], isFound: false }]);
  });

  test('is requested again while the pointer rests, but not without end', async () => {
    await setPoint(A);
    let asked = 0;
    const path = tracing.path.bind(tracing);
    tracing.path = async (request) => {
      asked += 1;
      return asked < 3 ? null : path(request);
    };
    target.value = C;
    await idle();
    expect(asked).toBe(3);
    expect(livePaths.value[0]?.isFound).toBe(true);
    target.value = [1, 1, FLOOR - 1];
    await idle();
    expect(asked).toBe(43);
  });

  test('leads to both neighbours of a dragged point', async () => {
    for (const point of [A, B, C]) {
      await setPoint(point);
    }
    dragged.value = { id: drawn.value?.id ?? -1, number: 1, point: [9, 9, 9] };
    await idle();
    expect(livePaths.value.map(({ points }) => [points[0], points.at(-1)])).toEqual([
      [A, [9, 9, 9]],
      [C, [9, 9, 9]],
    ]);
  });

  test('while a request runs, only the latest position is remembered', async () => {
    await setPoint(A);
    await idle();
    let asked = 0;
    const path = tracing.path.bind(tracing);
    tracing.path = (request) => {
      asked += 1;
      return path(request);
    };
    for (let n = 1; n <= 20; n++) {
      target.value = [n, 0, 0];
    }
    await idle();
    expect(asked).toBe(2);
    expect(livePaths.value[0]?.points.at(-1)).toEqual([20, 0, 0]);
  });
});
