/** Tests of the order in which `Latest` and `Queue` run tasks. */
import { describe, expect, test } from 'vitest';
import { Latest } from '../src/core/latest';
import { Queue } from '../src/worker/host';

function held(name: string, log: string[]) {
  let release: () => void = () => undefined;
  const ended = new Promise<void>((resolve) => {
    release = resolve;
  });
  const work = async () => {
    log.push(name);
    await ended;
  };
  return { work, release };
}

const soon = () => new Promise((resolve) => setTimeout(resolve, 0));

describe('Latest', () => {
  test('of tasks that arrive meanwhile, only the latest runs', async () => {
    const [latest, log] = [new Latest(), [] as string[]];
    const [a, b, c] = [held('a', log), held('b', log), held('c', log)];
    latest.run(a.work);
    latest.run(b.work);
    latest.run(c.work);
    expect(log).toEqual(['a']);
    a.release();
    await soon();
    expect(log).toEqual(['a', 'c']);
    c.release();
    await soon();
    const d = held('d', log);
    latest.run(d.work);
    expect(log).toEqual(['a', 'c', 'd']);
  });
});

describe('Queue', () => {
  test('tasks run one after the other, in order', async () => {
    const [queue, log] = [new Queue(), [] as string[]];
    const [a, b] = [held('a', log), held('b', log)];
    const done = [queue.run(a.work), queue.run(b.work), queue.run(() => 3)];
    await soon();
    expect(log).toEqual(['a']);
    b.release();
    await soon();
    expect(log).toEqual(['a']);
    a.release();
    expect((await Promise.all(done))[2]).toBe(3);
    expect(log).toEqual(['a', 'b']);
  });

  test('a task that fails reports it and does not block later tasks', async () => {
    const queue = new Queue();
    const failed = queue.run(() => {
      throw new Error('no');
    });
    const next = queue.run(() => 'yes');
    await expect(failed).rejects.toThrow('no');
    expect(await next).toBe('yes');
  });
});
