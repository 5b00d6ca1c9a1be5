import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import { turnedAbout } from '../src/core/camera';
import { Failure } from '../src/core/failure';
import type { Answer, Asked, Camera, Message, Question, Vector } from '../src/core/messages';
import { destination, flyTo } from '../src/state/flight';
import * as store from '../src/state/store';
import { connect } from '../src/worker/engine';
import { CAMERA } from './helpers';

const TURNED_CAMERA = turnedAbout({ ...CAMERA, pixel_spacing: 0.25 }, [0, 0, 0], [0, 0, 1], 1);

/** Recorded requests for flights, and the requested views; each view is identified by its centre. */
let asked: Message<'flight'>[] = [];
const viewsOf = ({ from, to, views }: Message<'flight'>): Camera[] =>
  Array.from({ length: views }, (_, n) => ({ ...(n < views - 1 ? from : to), center: [n, 0, 0] }));
let answer: () => Promise<Camera[]>;
const engine: Asked = {
  ask: <N extends Question>(_: N, message: Message<N>) => {
    asked.push(message as Message<'flight'>);
    return answer() as Promise<Answer<N>>;
  },
};
connect(engine);
const answered = () => new Promise<void>((done) => setTimeout(done, 0));

describe('a flight', () => {
  let now = 0;
  let steps: FrameRequestCallback[] = [];
  const pass = (milliseconds: number) => {
    now += milliseconds;
    for (const step of steps.splice(0)) {
      step(now);
    }
  };

  beforeEach(() => {
    [now, steps, asked] = [0, [], []];
    answer = () => Promise.resolve(asked.slice(-1).flatMap(viewsOf));
    vi.spyOn(performance, 'now').mockImplementation(() => now);
    vi.stubGlobal('requestAnimationFrame', (step: FrameRequestCallback) => steps.push(step));
    vi.stubGlobal('window', { matchMedia: () => ({ matches: false }) });
    store.camera.value = CAMERA;
    store.isTurning.value = false;
    store.problem.value = null;
  });
  afterEach(async () => {
    await answered();
    pass(1000);
    vi.restoreAllMocks();
    vi.unstubAllGlobals();
  });

  test('shows the views of the engine at their times, in less than half a second, and ends exactly at its destination', async () => {
    flyTo(TURNED_CAMERA);
    expect(destination.value).toBe(TURNED_CAMERA);
    await answered();
    expect(asked).toEqual([{ from: CAMERA, to: TURNED_CAMERA, views: 49 }]);
    for (const [at, view] of [
      [0, 0],
      [100, 12],
      [102, 12],
      [200, 24],
      [391, 47],
    ] as const) {
      pass(at - now);
      expect(store.camera.value).toEqual({ ...CAMERA, center: [view, 0, 0] });
    }
    pass(300);
    expect(store.camera.value).toEqual(TURNED_CAMERA);
    expect([destination.value, steps.length]).toEqual([null, 0]);
  });

  test('continues if its pane changes size, also before the engine has answered', async () => {
    flyTo(TURNED_CAMERA);
    store.camera.value = { ...CAMERA, size: [200, 150], pixel_spacing: 2 * CAMERA.pixel_spacing };
    await answered();
    pass(100);
    expect(store.camera.value).toMatchObject({ center: [12, 0, 0], size: [200, 150] });
    const camera = store.camera.value ?? CAMERA;
    store.camera.value = { ...camera, size: [400, 300], pixel_spacing: 0.5 * camera.pixel_spacing };
    pass(400);
    expect(store.camera.value).toEqual(TURNED_CAMERA);
  });

  test.each([true, false])(
    'ends where something else moves the camera; after the answer: %s',
    async (isLate) => {
      flyTo(TURNED_CAMERA);
      if (isLate) {
        await answered();
        pass(100);
      }
      const moved = { ...CAMERA, center: [1, 2, 3] as Vector };
      store.camera.value = moved;
      await answered();
      pass(100);
      pass(400);
      expect(store.camera.value).toBe(moved);
      expect(destination.value).toBeNull();
    },
  );

  test('ends if another flight begins', async () => {
    flyTo(TURNED_CAMERA);
    const last = { ...CAMERA, pixel_spacing: 1 };
    flyTo(last);
    await answered();
    pass(100);
    pass(400);
    expect(store.camera.value).toEqual(last);
  });

  test('does not begin if the engine rejects it, and the page says why', async () => {
    store.report.value = { volume: null, vessels: [], windows: null };
    answer = () => Promise.reject(new Failure('camera', 'size of the flight', 'two', 'one'));
    flyTo(TURNED_CAMERA);
    await answered();
    expect([store.camera.value, destination.value, steps.length]).toEqual([CAMERA, null, 0]);
    expect(store.problem.value?.subject).toBe('size of the flight');
    store.report.value = null;
  });

  test.each([true, false])('is none where the view turns already, or no motion is wanted', (isTurning) => {
    store.isTurning.value = isTurning;
    vi.stubGlobal('window', { matchMedia: () => ({ matches: !isTurning }) });
    flyTo({ ...TURNED_CAMERA, size: [200, 150], pixel_spacing: 0.5 });
    expect(store.camera.value).toEqual(TURNED_CAMERA);
    expect([asked, steps]).toEqual([[], []]);
  });
});
