import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Precedence } from '../src/core/precedence';

/** A fake worker that handles one request at a time; its views can be stopped. */
class FakeWorker {
  stops = 0;
  private last: Promise<unknown> = Promise.resolve();
  private refuse: (() => void) | null = null;

  constructor(private readonly canStop = true) {}

  readonly stop = (): void => {
    this.stops += 1;
    if (this.canStop) {
      this.refuse?.();
    }
  };

  work(milliseconds: number): Promise<string> {
    return this.after(() => new Promise((resolve) => setTimeout(() => resolve('done'), milliseconds)));
  }

  view(milliseconds: number): Promise<string> {
    return this.after(
      () =>
        new Promise((resolve, reject) => {
          this.refuse = () => reject(new Error('stopped'));
          setTimeout(() => resolve('drawn'), milliseconds);
        }),
    );
  }

  private after(work: () => Promise<string>): Promise<string> {
    const next = this.last.then(work, work);
    this.last = next.catch(() => undefined);
    return next;
  }
}

const REFINING = 1200;

beforeEach(() => {
  vi.useFakeTimers();
});

afterEach(() => {
  vi.useRealTimers();
});

function begun(worker: FakeWorker, isRefining: boolean, milliseconds = REFINING) {
  const precedence = new Precedence(worker.stop);
  const ends: string[] = [];
  const draw = () =>
    precedence.view(isRefining, worker.view(milliseconds)).then(
      () => ends.push('drawn'),
      () => ends.push('stopped'),
    );
  return { precedence, ends, draw };
}

async function waited(answer: Promise<unknown>): Promise<number> {
  const from = Date.now();
  let took = Number.NaN;
  void answer.then(() => {
    took = Date.now() - from;
  });
  await vi.advanceTimersByTimeAsync(5000);
  return took;
}

test('a request does not wait for a view that only refines the picture', async () => {
  const worker = new FakeWorker();
  const { precedence, ends, draw } = begun(worker, true);
  void draw();
  await vi.advanceTimersByTimeAsync(10);
  expect(await waited(precedence.first(worker.work(30)))).toBe(30);
  expect(ends).toEqual(['stopped']);
});

test('a request waits only briefly for a view in motion', async () => {
  const worker = new FakeWorker();
  const { precedence, ends, draw } = begun(worker, false);
  void draw();
  await vi.advanceTimersByTimeAsync(10);
  expect(await waited(precedence.first(worker.work(30)))).toBeLessThan(100);
  expect(ends).toEqual(['stopped']);
});

test('a quick view in motion is not stopped', async () => {
  const worker = new FakeWorker();
  const { precedence, ends, draw } = begun(worker, false, 40);
  void draw();
  expect(await waited(precedence.first(worker.work(10)))).toBe(50);
  expect([worker.stops, ends]).toEqual([0, ['drawn']]);
});

test('a view that waits in the queue is stopped once it begins', async () => {
  const worker = new FakeWorker();
  const { precedence, ends, draw } = begun(worker, true);
  void precedence.first(worker.work(50));
  void draw();
  expect(await waited(precedence.first(worker.work(30)))).toBe(60 + 30);
  expect(ends).toEqual(['stopped']);
});

test('several requests stop a view only once', async () => {
  const worker = new FakeWorker();
  const { precedence, draw } = begun(worker, true);
  void draw();
  await vi.advanceTimersByTimeAsync(10);
  await waited(Promise.all([1, 2, 3].map(() => precedence.first(worker.work(5)))));
  expect(worker.stops).toBe(1);
});

test('a view that was stopped several times runs to completion, and counting starts again', async () => {
  const worker = new FakeWorker();
  const { precedence, ends, draw } = begun(worker, true);
  for (let n = 0; n < 9; n++) {
    void draw();
    await vi.advanceTimersByTimeAsync(10);
    await waited(precedence.first(worker.work(5)));
  }
  const stopped = Array<string>(6).fill('stopped');
  expect(ends).toEqual([...stopped, 'drawn', 'stopped', 'stopped']);
});

test('nothing is stopped if no view is being rendered', async () => {
  const worker = new FakeWorker();
  const { precedence, draw } = begun(worker, true);
  expect(await waited(precedence.first(worker.work(30)))).toBe(30);
  await Promise.all([draw(), vi.advanceTimersByTimeAsync(REFINING)]);
  expect(await waited(precedence.first(worker.work(30)))).toBe(30);
  expect(worker.stops).toBe(0);
});

test('if views cannot be stopped, the answer comes after them', async () => {
  const worker = new FakeWorker(false);
  const { precedence, ends, draw } = begun(worker, true);
  void draw();
  await vi.advanceTimersByTimeAsync(200);
  expect(await waited(precedence.first(worker.work(30)))).toBe(REFINING - 200 + 30);
  expect(ends).toEqual(['drawn']);
});
