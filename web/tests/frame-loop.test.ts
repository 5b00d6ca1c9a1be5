import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Drawn, View } from '../src/core/messages';
import { FrameLoop, type Shown } from '../src/views/frame-loop';
import { connect } from '../src/worker/engine';
import { CAMERA } from './helpers';

const VIEW: View = { camera: CAMERA, method: 'csr', settings: { levels: 3 } };
const other = (x: number): View => ({ ...VIEW, camera: { ...CAMERA, center: [x, 0, 0] } });

/** A frame takes `time(view)` ms. If the time is NaN, it fails at once; if negative, after that many ms. */
class FakeEngine {
  readonly asked: View[] = [];
  underWay = 0;
  most = 0;
  stops = 0;
  private refuse: ((error: unknown) => void) | null = null;

  constructor(readonly time: (view: View) => number) {}

  render(view: View): Promise<Drawn> {
    this.asked.push(view);
    this.underWay += 1;
    this.most = Math.max(this.most, this.underWay);
    const milliseconds = this.time(view);
    return new Promise<Drawn>((resolve, reject) => {
      this.refuse = reject;
      const lost = new Failure('device', 'the GPU', 'it was lost', 'one that works');
      if (Number.isNaN(milliseconds)) {
        reject(lost);
      } else if (milliseconds < 0) {
        setTimeout(() => reject(lost), -milliseconds);
      } else {
        setTimeout(() => resolve({ picture: null, milliseconds }), milliseconds);
      }
    }).finally(() => {
      this.underWay -= 1;
      this.refuse = null;
    });
  }

  stop(): void {
    this.stops += 1;
    this.refuse?.(new Failure('interrupted', 'the view', 'a stop', 'none'));
  }
}

let shown: Shown[];
let failures: Failure[];

function loopOf(time: (view: View) => number) {
  const engine = new FakeEngine(time);
  connect(engine);
  const loop = new FrameLoop(
    (picture) => shown.push(picture),
    (failure) => failures.push(failure),
  );
  return { engine, loop };
}

const lasts = () => shown.map(({ isLast }) => isLast);
const stages = () => shown.map(({ stage }) => stage);
const lastMoving = (engine: FakeEngine) =>
  engine.asked.filter((view) => view.settings.context_preview).at(-1) as View;
const pixels = (view: View) => view.camera.size[0] * view.camera.size[1];

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal('window', {
    setTimeout: (work: () => void, time: number) => setTimeout(work, time),
    clearTimeout: (timer: number) => clearTimeout(timer),
    devicePixelRatio: 1,
  });
  shown = [];
  failures = [];
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe('at rest', () => {
  test('a picture in full resolution follows, then a supersampled one, then nothing', async () => {
    const { engine, loop } = loopOf(() => 20);
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(10_000);
    expect(stages()).toEqual(['moving', 'full', 'samples']);
    expect(lasts()).toEqual([false, false, true]);
    const plain = { levels: 3, edge_samples: 1 };
    expect(engine.asked[0]?.settings).toEqual({ ...plain, context_preview: true, samples: 1 });
    expect(engine.asked[1]).toEqual({ ...VIEW, settings: { ...plain, turning_limit: null } });
    expect(engine.asked[2]?.settings).toEqual({ ...plain, turning_limit: null, samples: 2 });
    expect(vi.getTimerCount()).toBe(0);
  });

  test('full resolution is shown within 300 ms if it takes 100 ms', async () => {
    const { loop } = loopOf(() => 100);
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(300);
    expect(stages()).toContain('full');
  });

  test('slow pictures are not supersampled', async () => {
    const { loop } = loopOf(() => 900);
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(10_000);
    expect(stages()).toEqual(['moving', 'full']);
    expect(lasts()).toEqual([false, true]);
  });

  test('a picture is not the last one if another view was requested meanwhile', async () => {
    const { loop } = loopOf(() => 900);
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(100);
    loop.want(other(1));
    await vi.advanceTimersByTimeAsync(10_000);
    expect(shown.map(({ wanted, isLast }) => [wanted.camera.center[0], isLast])).toEqual([
      [VIEW.camera.center[0], false],
      [1, false],
      [1, true],
    ]);
  });

  test('a high-resolution screen gets its own pixels, at most two per CSS pixel and side', async () => {
    Object.assign(window, { devicePixelRatio: 3 });
    const { engine, loop } = loopOf(() => 20);
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(1000);
    expect(engine.asked.map(({ camera }) => camera.size)).toEqual([
      [400, 300],
      [800, 600],
      [800, 600],
    ]);
  });
});

describe('while the view moves', () => {
  test('one picture is rendered at a time, and the latest view comes next', async () => {
    const { engine, loop } = loopOf(() => 30);
    loop.want(other(1));
    loop.want(other(2));
    loop.want(other(3));
    await vi.advanceTimersByTimeAsync(40);
    expect(engine.asked.map(({ camera }) => camera.center[0])).toEqual([1, 3]);
    await vi.advanceTimersByTimeAsync(5000);
    expect(engine.most).toBe(1);
    expect(shown.at(-1)?.wanted).toEqual(other(3));
  });

  test('the resolution adapts until a picture takes the wanted time', async () => {
    const { loop } = loopOf((view) => (400 * pixels(view)) / pixels(VIEW));
    for (let n = 0; n < 40; n++) {
      loop.want(other(n));
      await vi.advanceTimersByTimeAsync(30);
    }
    const last = shown.filter(({ stage }) => stage === 'moving').at(-1);
    expect(last?.drawn.milliseconds).toBeGreaterThan(25);
    expect(last?.drawn.milliseconds).toBeLessThan(62);
    expect(new Set(stages())).toEqual(new Set(['moving']));
  });

  test('the resolution has a lower limit, and rises again if there is time', async () => {
    let slow = 4000;
    const { loop, engine } = loopOf(() => slow);
    for (let n = 0; n < 10; n++) {
      loop.want(other(n));
      await vi.advanceTimersByTimeAsync(4001);
    }
    expect(lastMoving(engine).camera.size).toEqual([80, 60]);
    slow = 1;
    for (let n = 0; n < 40; n++) {
      loop.want(other(n));
      await vi.advanceTimersByTimeAsync(20);
    }
    expect(lastMoving(engine).camera.size).toEqual([400, 300]);
  });

  test('the adapted resolution is kept while the view rests', async () => {
    const { engine, loop } = loopOf((view) => (1600 * pixels(view)) / pixels(VIEW));
    for (let n = 0; n < 20; n++) {
      loop.want(other(n));
      await vi.advanceTimersByTimeAsync(100);
    }
    await vi.advanceTimersByTimeAsync(10_000);
    expect(stages().at(-1)).toBe('full');
    loop.want(other(99));
    expect(engine.time(lastMoving(engine))).toBeLessThan(80);
  });

  test('a picture in full resolution is stopped for a new view', async () => {
    const { engine, loop } = loopOf(({ settings }) => (settings.context_preview ? 20 : 500));
    loop.want(other(1));
    await vi.advanceTimersByTimeAsync(200);
    expect(engine.underWay).toBe(1);
    loop.want(other(2));
    expect(engine.stops).toBe(1);
    await vi.advanceTimersByTimeAsync(60);
    expect(shown.at(-1)?.wanted).toEqual(other(2));
    expect(failures).toEqual([]);
  });

  test('a picture of a moving view is not stopped', async () => {
    const { engine, loop } = loopOf(() => 50);
    loop.want(other(1));
    await vi.advanceTimersByTimeAsync(10);
    loop.want(other(2));
    expect(engine.stops).toBe(0);
  });
});

describe('a view that was stopped', () => {
  test('at rest is rendered again after a pause that doubles each time', async () => {
    const { engine, loop } = loopOf(({ settings }) => (settings.context_preview ? 20 : 500));
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(200);
    const asked: number[] = [];
    for (let n = 0; n < 3; n++) {
      engine.stop();
      const [from, before] = [Date.now(), engine.asked.length];
      while (engine.asked.length === before) {
        await vi.advanceTimersByTimeAsync(1);
      }
      asked.push(Date.now() - from);
    }
    expect(asked).toEqual([80, 160, 320]);
    await vi.advanceTimersByTimeAsync(10_000);
    expect(stages()).toEqual(['moving', 'full', 'samples']);
    expect(failures).toEqual([]);
  });

  test('in motion is rendered again at once, with fewer pixels', async () => {
    const { engine, loop } = loopOf((view) => (4000 * pixels(view)) / pixels(VIEW));
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(100);
    engine.stop();
    await vi.advanceTimersByTimeAsync(1);
    expect(engine.asked.map(({ camera }) => camera.size)).toEqual([
      [400, 300],
      [200, 150],
    ]);
  });
});

describe('failures', () => {
  test('are reported once, and the next view is rendered', async () => {
    let isBroken = true;
    const { loop } = loopOf(() => (isBroken ? Number.NaN : 20));
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(2000);
    expect(failures.map(({ kind }) => kind)).toEqual(['device']);
    isBroken = false;
    loop.again();
    await vi.advanceTimersByTimeAsync(2000);
    expect(stages()).toEqual(['moving', 'full', 'samples']);
  });
});

test('the first picture of a device may be slow: only the next one decides about supersampling', async () => {
  const slow = { pictures: 1 };
  const { engine, loop } = loopOf((view) => {
    const isSlow = !view.settings.context_preview && slow.pictures > 0;
    slow.pictures -= isSlow ? 1 : 0;
    return isSlow ? 900 : 50;
  });
  loop.want(VIEW);
  await vi.advanceTimersByTimeAsync(5000);
  expect(stages()).toEqual(['moving', 'full']);
  for (const [pictures, expected] of [
    [1, ['moving', 'full', 'full', 'samples']],
    // If a view is always slow, it is rendered in full only twice.
    [9, ['moving', 'full', 'full']],
  ] as const) {
    shown = [];
    slow.pictures = pictures;
    loop.again();
    await vi.advanceTimersByTimeAsync(20_000);
    expect(stages()).toEqual(expected);
  }
  expect(engine.most).toBe(1);
});

test('nothing is shown after the end', async () => {
  const { engine, loop } = loopOf(() => 50);
  loop.want(VIEW);
  await vi.advanceTimersByTimeAsync(10);
  loop.end();
  await vi.advanceTimersByTimeAsync(5000);
  loop.want(other(1));
  await vi.advanceTimersByTimeAsync(5000);
  expect(shown).toEqual([]);
  expect(engine.asked).toHaveLength(1);
});

describe('after the device changed while a picture was rendered', () => {
  test('that picture is not shown, and the view is rendered again', async () => {
    const { engine, loop } = loopOf(() => 50);
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(20);
    loop.again();
    await vi.advanceTimersByTimeAsync(1000);
    expect(engine.asked).toHaveLength(4);
    expect(stages()).toEqual(['moving', 'full', 'samples']);
    expect(engine.most).toBe(1);
  });

  test('its failure is not reported', async () => {
    let time = -50;
    const { loop } = loopOf(() => time);
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(20);
    time = 30;
    loop.again();
    await vi.advanceTimersByTimeAsync(1000);
    expect(failures).toEqual([]);
    expect(stages()).toEqual(['moving', 'full', 'samples']);
  });

  test('a later failure is reported', async () => {
    const { loop } = loopOf(() => -50);
    loop.want(VIEW);
    await vi.advanceTimersByTimeAsync(20);
    loop.again();
    await vi.advanceTimersByTimeAsync(1000);
    expect(failures.map(({ kind }) => kind)).toEqual(['device']);
  });
});
