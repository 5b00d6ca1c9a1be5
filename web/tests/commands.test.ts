import { beforeEach, describe, expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Vector } from '../src/core/messages';
import { addMask, findVessels } from '../src/edit/branches';
import { addClick, addStopper, beginVessel, begunId, setBridge } from '../src/edit/clicks';
import { hide, recolor, remove, rename } from '../src/edit/vessels';
import { centerlineFile } from '../src/output/save-actions';
import { editQueue } from '../src/state/edit-queue';
import { document_, redo, redoWords, undo, undoWords } from '../src/state/history';
import { beginStudy } from '../src/state/shown';
import * as store from '../src/state/store';
import { connect } from '../src/worker/engine';
import { documentOf, FakeTracing, FLOOR } from './fake-tracing';

const A: Vector = [0, 0, 0];
const B: Vector = [10, 0, 0];
const C: Vector = [20, 5, 0];
const AIR: Vector = [5, 5, FLOOR - 1];

let tracing: FakeTracing;
const clicks = (n = 0) => document_.value.vessels[n]?.clicks;

beforeEach(() => {
  tracing = new FakeTracing();
  connect(tracing);
  store.problem.value = null;
  store.crossHair.value = null;
  store.notes.value = [];
  beginStudy(documentOf());
});

async function begun(from = A, to = B): Promise<number> {
  const id = begunId(await beginVessel([from, to]));
  expect(id).not.toBeNull();
  return id ?? -1;
}

describe('an edit', () => {
  test('is one undo step with the description from the engine', async () => {
    const id = await begun();
    expect(document_.value.vessels).toMatchObject([{ id, clicks: [A, B] }]);
    expect(undoWords.value).toBe('begin_vessel');
    undo();
    expect(document_.value.vessels).toEqual([]);
    expect(undoWords.value).toBeNull();
  });

  test('sends the current document to the engine, without data that only the page needs', async () => {
    await begun();
    await addStopper(C);
    const { vessels, stoppers } = document_.value;
    await setBridge(true);
    expect(tracing.edits.at(-1)).toEqual({
      document: { vessels, stoppers, bridge: false, bone_hidden: false, dark: false },
      edit: { kind: 'set_bridge', bridge: true },
      bridging: false,
    });
  });

  test('is requested again if the user has redone a step meanwhile', async () => {
    const id = await begun();
    await addClick(id, C);
    undo();
    let open = () => {};
    tracing.gate = new Promise((resolve) => {
      open = resolve;
    });
    const adding = addClick(id, A);
    await Promise.resolve();
    redo();
    open();
    await adding;
    expect(clicks()).toEqual([A, B, C, A]);
  });

  test('that arrive while one is traced wait for it', async () => {
    const id = await begun();
    let open = () => {};
    tracing.gate = new Promise((resolve) => {
      open = resolve;
    });
    const both = [addClick(id, C), addClick(id, A)];
    expect(editQueue.state.queued).toEqual(['add_click', 'add_click']);
    open();
    expect((await Promise.all(both)).map(Boolean)).toEqual([true, true]);
    expect(clicks()).toEqual([A, B, C, A]);
    expect(editQueue.state.phase).toBe('idle');
  });
});

describe('a rejected click', () => {
  test('changes nothing, and the cross-hair jumps to the least lumen-like point', async () => {
    const id = await begun();
    const before = document_.value;
    expect(await addClick(id, AIR)).toBeNull();
    expect(document_.value).toBe(before);
    expect(undoWords.value).toBe('begin_vessel');
    expect(store.problem.value?.message).toContain('no lumen');
    expect(store.crossHair.value).toMatchObject({ point: AIR, value: 35 });
    expect(editQueue.state.refusal?.failure).toBe(store.problem.value);
  });

  test('is accepted if the gap is bridged, as one undo step', async () => {
    const id = await begun();
    await addClick(id, AIR);
    editQueue.state.refusal?.bridge?.();
    await expect.poll(() => clicks()).toEqual([A, B, AIR]);
    expect(document_.value.bridge).toBe(true);
    expect(store.problem.value).toBeNull();
    undo();
    expect(document_.value.bridge).toBe(false);
    expect(clicks()).toEqual([A, B]);
  });

  test('drops clicks that wait behind it', async () => {
    const id = await begun();
    const both = [addClick(id, AIR), addClick(id, C)];
    expect(await Promise.all(both)).toEqual([null, null]);
    expect(clicks()).toEqual([A, B]);
    expect(await addClick(id, C)).not.toBeNull();
  });

  test('offers no bridge if none would help', async () => {
    tracing.edit = () => Promise.reject(new Failure('tracing', 'x', 'y', 'z', '', { place: AIR }));
    await beginVessel([A, B]);
    expect(editQueue.state.refusal?.bridge).toBeNull();
  });
});

test('an edit that was stopped, or whose study was closed, does nothing', async () => {
  const id = await begun();
  const stopped = addClick(id, C);
  editQueue.drop();
  expect(await stopped).toBeNull();
  const late = addClick(id, C);
  beginStudy(null);
  expect(await late).toBeNull();
  expect(document_.value.vessels).toEqual([]);
  expect(store.problem.value).toBeNull();
});

test('changes made while a vessel is traced are kept', async () => {
  const id = await begun();
  let open = () => {};
  tracing.gate = new Promise((resolve) => {
    open = resolve;
  });
  const adding = addClick(id, C);
  const { change } = await import('../src/state/history');
  change('mark', { ...document_.value, rulers: [{ from: A, to: B }] });
  open();
  await adding;
  expect(document_.value.rulers).toHaveLength(1);
  expect(clicks()).toEqual([A, B, C]);
});

test('notes about a mask are shown once', async () => {
  tracing.notes = ['the mask has holes'];
  await addMask([]);
  await addMask([]);
  expect(store.notes.value).toEqual(['the mask has holes']);
});

test('finding all vessels is one undo step, and notes about the scan are shown once', async () => {
  tracing.notes = ['the lumen of the vessels has about 330'];
  expect(await findVessels()).toBe(true);
  expect(tracing.edits.at(-1)?.edit).toEqual({ kind: 'find_vessels', doubtful: false });
  expect(await findVessels()).toBe(true);
  expect(store.notes.value).toEqual(tracing.notes);
});

describe('whole vessels', () => {
  test('are renamed, coloured, hidden and deleted', async () => {
    const id = await begun();
    await rename(id, 'SMA');
    await recolor(id, '#cc79a7');
    await hide(id, true);
    expect(document_.value.vessels).toMatchObject([{ name: 'SMA', color: '#cc79a7', isHidden: true }]);
    await remove([id]);
    expect(document_.value.vessels).toEqual([]);
  });

  test('an unchanged value makes no undo step', async () => {
    const id = await begun();
    await rename(id, document_.value.vessels[0]?.name ?? '');
    await hide(id, false);
    expect(undoWords.value).toBe('begin_vessel');
  });

  test('change their fields at once, without the engine', async () => {
    const id = await begun();
    const asked = tracing.edits.length;
    await Promise.all([rename(id, 'SMA'), recolor(id, '#cc79a7'), hide(id, true)]);
    expect(tracing.edits).toHaveLength(asked);
    expect(undoWords.value).toBe('hide a vessel');
  });
});

test('a centerline file contains all vessels except doubtful ones', async () => {
  const { vessels, ...rest } = documentOf(1, 2, 3);
  const doubts = [null, 'touches bone', null];
  beginStudy({ ...rest, vessels: vessels.map((vessel, n) => ({ ...vessel, doubt: doubts[n] ?? null })) });
  await hide(3, true);
  const file = await centerlineFile('vtp');
  expect(await file.text()).toBe('vtp: n1,n3');
});

test('thirty steps are undone and redone exactly', async () => {
  const id = await begun();
  const states = [document_.value];
  for (let n = 0; n < 29; n++) {
    await addClick(id, [n, 1, 0]);
    states.push(document_.value);
  }
  for (let n = 28; n >= 0; n--) {
    undo();
    expect(document_.value).toEqual(states[n]);
  }
  undo();
  expect(document_.value.vessels).toEqual([]);
  expect(undoWords.value).toBeNull();
  for (const state of states) {
    redo();
    expect(document_.value).toEqual(state);
  }
  expect(redoWords.value).toBeNull();
});
