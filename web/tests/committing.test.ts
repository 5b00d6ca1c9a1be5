import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { Asked, Edit, Progress } from '../src/core/messages';
import { commit } from '../src/edit/committing';
import { EMPTY } from '../src/state/document';
import { editQueue } from '../src/state/edit-queue';
import { progress } from '../src/state/store';
import { connect } from '../src/worker/engine';

const FINDING: Progress = { words: 'Finding vessels', done: 0, total: null };

/** A fake engine that reports progress and answers only when the test says so. */
class Slow {
  onProgress: (report: Progress) => void = () => {};
  end: () => void = () => {};
  readonly asked = { ask: (_name, _message, { onProgress } = {}) => this.answer(onProgress) } as Asked;

  private answer(onProgress: ((report: Progress) => void) | undefined): Promise<never> {
    this.onProgress = onProgress ?? this.onProgress;
    const edited = {
      document: EMPTY,
      words: 'x',
      added: [],
      without_marks: [],
      notes: [],
      doubts: [],
      told: null,
    };
    const answer = { edited, report: null, lines: [], facts: [], pick: null };
    return new Promise((resolve) => {
      this.end = () => resolve(answer as never);
    });
  }
}

beforeEach(() => {
  vi.useFakeTimers();
  editQueue.drop();
});
afterEach(() => {
  vi.useRealTimers();
});

async function begun(
  edit: Edit = { kind: 'find_vessels', doubtful: false },
): Promise<{ slow: Slow; done: Promise<unknown> }> {
  const slow = new Slow();
  connect(slow.asked);
  const done = commit(edit);
  await vi.advanceTimersByTimeAsync(0);
  return { slow, done };
}

test('an edit that reports progress only at its start is still shown as running', async () => {
  const { slow, done } = await begun();
  slow.onProgress(FINDING);
  expect(progress.value).toBeNull();
  await vi.advanceTimersByTimeAsync(1000);
  expect(progress.value).toEqual(FINDING);
  slow.end();
  await done;
  expect(progress.value).toBeNull();
});

test('progress reported after the end of an edit is not shown', async () => {
  const { slow, done } = await begun();
  await vi.advanceTimersByTimeAsync(1000);
  slow.end();
  await done;
  slow.onProgress({ ...FINDING, done: 90, total: 100 });
  expect(progress.value).toBeNull();
});

test('the progress of an edit that was dropped goes with the edit', async () => {
  const { slow, done } = await begun();
  slow.onProgress(FINDING);
  await vi.advanceTimersByTimeAsync(1000);
  editQueue.drop();
  slow.onProgress({ ...FINDING, done: 5 });
  expect(progress.value).toEqual(FINDING);
  slow.end();
  await done;
  expect(progress.value).toBeNull();
});

test('a quick edit shows no progress', async () => {
  const { slow, done } = await begun();
  slow.onProgress(FINDING);
  slow.end();
  await done;
  await vi.advanceTimersByTimeAsync(1000);
  expect(progress.value).toBeNull();
});

test('after 20 s of searching branches the page asks, and the search continues meanwhile', async () => {
  const { slow, done } = await begun({ kind: 'add_branches', seed: [0, 0, 0] });
  await vi.advanceTimersByTimeAsync(19_900);
  expect(editQueue.state.isLong).toBe(false);
  await vi.advanceTimersByTimeAsync(200);
  expect(editQueue.state.isLong).toBe(true);
  slow.end();
  await done;
  expect(editQueue.state.isLong).toBe(false);
});

test('the page does not ask during a search of the whole scan, nor about branches found in time', async () => {
  const whole = await begun();
  await vi.advanceTimersByTimeAsync(30_000);
  expect(editQueue.state.isLong).toBe(false);
  whole.slow.end();
  await whole.done;
  const branches = await begun({ kind: 'add_branches', seed: [0, 0, 0] });
  branches.slow.end();
  await branches.done;
  await vi.advanceTimersByTimeAsync(30_000);
  expect(editQueue.state.isLong).toBe(false);
});
