/** The queue of edits by itself, with work that ends when the test says so. */
import { beforeEach, expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Vector } from '../src/core/messages';
import { type Document, EMPTY } from '../src/state/document';
import { type EditKind, EditQueue, type Step } from '../src/state/edit-queue';
import { begin, document_, undo, undoWords } from '../src/state/history';
import * as store from '../src/state/store';

let queue: EditQueue;
let ends: Map<string, (error?: Failure) => void>;
let begun: string[];

beforeEach(() => {
  queue = new EditQueue();
  ends = new Map();
  begun = [];
  store.problem.value = null;
  begin(EMPTY);
});

const ruler = (x: number) => ({ from: [x, 0, 0] as Vector, to: [x, 1, 0] as Vector });
const rulers = () => document_.value.rulers.map(({ from }) => from[0]);
const withRuler = (document: Document, x: number): Document => ({
  ...document,
  rulers: [...document.rulers, ruler(x)],
});

/** An edit that adds a ruler at `x` to the document of the moment at which it ends. */
function added(x: number, kind: EditKind = 'add_click'): Promise<number | null> {
  const name = String(x);
  const work = () => {
    begun.push(name);
    return new Promise<Step<number>>((resolve, reject) => {
      ends.set(name, (error) =>
        error ? reject(error) : resolve({ words: name, after: withRuler(document_.value, x), result: x }),
      );
    });
  };
  return queue.add(kind, work);
}

async function end(x: number, error?: Failure): Promise<void> {
  await expect.poll(() => ends.has(String(x))).toBe(true);
  ends.get(String(x))?.(error);
}

const rejected = () => new Failure('tracing', 'the way', 'no lumen', 'a vessel');

test('an idle queue says so', () => {
  expect(queue.state).toEqual({ phase: 'idle', running: null, queued: [], isLong: false, refusal: null });
  expect([queue.isBusy, queue.isSearching]).toEqual([false, false]);
});

test('edits run one after another in their order, and the queue tells which', async () => {
  const all = [added(1, 'begin_vessel'), added(2, 'find_vessels'), added(3)];
  expect(queue.state).toMatchObject({ phase: 'waiting', running: null });
  await Promise.resolve();
  expect(queue.state).toMatchObject({ phase: 'running', running: 'begin_vessel' });
  expect(queue.state.queued).toEqual(['find_vessels', 'add_click']);
  expect([begun, queue.isSearching]).toEqual([['1'], false]);
  await end(1);
  expect(await all[0]).toBe(1);
  await expect.poll(() => queue.isSearching).toBe(true);
  expect([begun, queue.state.queued]).toEqual([['1', '2'], ['add_click']]);
  await end(2);
  await end(3);
  expect(await Promise.all(all)).toEqual([1, 2, 3]);
  expect(rulers()).toEqual([1, 2, 3]);
  expect(queue.state.phase).toBe('idle');
});

test('a failed edit is told, drops those that wait behind it, and later ones run', async () => {
  const all = [added(1), added(2), added(3)];
  await end(1);
  const failure = rejected();
  await end(2, failure);
  expect(await Promise.all(all)).toEqual([1, null, null]);
  expect(queue.state).toMatchObject({ phase: 'idle', queued: [], refusal: { failure, bridge: null } });
  expect(store.problem.value).toBe(failure);
  expect(begun).toEqual(['1', '2']);
  const later = added(4);
  await end(4);
  expect(await later).toBe(4);
  expect([rulers(), queue.state.refusal, store.problem.value]).toEqual([[1, 4], null, null]);
});

test('an edit that was asked for while a failure is told is not lost', async () => {
  const failed = added(1);
  const next = failed.then(() => added(2));
  await end(1, rejected());
  await end(2);
  expect([await failed, await next, rulers()]).toEqual([null, 2, [2]]);
});

test('an undo while an edit runs is kept, and the edit is the step after it', async () => {
  const first = added(1);
  await end(1);
  await first;
  const second = added(2);
  await expect.poll(() => begun).toEqual(['1', '2']);
  undo();
  expect(rulers()).toEqual([]);
  await end(2);
  expect([await second, rulers(), undoWords.value]).toEqual([2, [2], '2']);
  undo();
  expect([rulers(), undoWords.value]).toEqual([[], null]);
});

test('a dropped edit changes nothing, and the next one waits until it has ended', async () => {
  const dropped = [added(1), added(2)];
  await expect.poll(() => begun).toEqual(['1']);
  queue.drop();
  expect(queue.state).toMatchObject({ phase: 'stopping', running: 'add_click', queued: [] });
  expect(await dropped[1]).toBeNull();
  const next = added(3);
  await Promise.resolve();
  expect([begun, queue.state.queued]).toEqual([['1'], ['add_click']]);
  await end(1);
  expect(await dropped[0]).toBeNull();
  await end(3);
  expect([await next, rulers(), begun]).toEqual([3, [3], ['1', '3']]);
});

test('a stop is no failure', async () => {
  const stopped = added(1);
  await end(1, new Failure('interrupted', 'tracing', 'a stop', 'none'));
  expect(await stopped).toBeNull();
  expect([queue.state.refusal, store.problem.value]).toEqual([null, null]);
});

test('an error message of something else is not closed by an edit', async () => {
  const other = new Failure('format', 'file', 'x', 'y');
  const failed = added(1);
  await end(1, rejected());
  await failed;
  store.problem.value = other;
  const later = added(2);
  await end(2);
  await later;
  expect([store.problem.value, queue.state.refusal]).toEqual([other, null]);
});
