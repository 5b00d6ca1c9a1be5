import { beforeEach, describe, expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Vector } from '../src/core/messages';
import { accept, addBranches, addMask, leaveOut } from '../src/edit/branches';
import { nameOf } from '../src/edit/changes';
import { addClick, beginVessel, insertClick, moveClick, removeClick, setBridge } from '../src/edit/clicks';
import { dropEdits, refusal, waiting } from '../src/edit/committing';
import { addLoaded, centerlineFile } from '../src/edit/files';
import { document_, redo, redoWords, undo, undoWords } from '../src/edit/history';
import { beginStudy } from '../src/edit/shown';
import { addStopper, moveStopper, removeStopper } from '../src/edit/stoppers';
import { cut, hide, join, recolor, remove, rename } from '../src/edit/vessels';
import * as store from '../src/state/store';
import { FakeTracing, FLOOR, reportOf } from './fake-tracing';

const A: Vector = [0, 0, 0];
const B: Vector = [10, 0, 0];
const C: Vector = [20, 5, 0];
const AIR: Vector = [5, 5, FLOOR - 1];

let tracing: FakeTracing;
const clicks = (n = 0) => document_.value.vessels[n]?.clicks;
const names = () => document_.value.vessels.map(nameOf);
const linePoints = (n = 0) => tracing.lines[document_.value.vessels[n]?.line ?? -1]?.points;

beforeEach(() => {
  tracing = new FakeTracing();
  store.problem.value = null;
  store.crossHair.value = null;
  store.notes.value = [];
  beginStudy(reportOf([]));
});

/** A vessel with two clicks. */
async function begun(from = A, to = B): Promise<number> {
  const id = await beginVessel(tracing, [from, to]);
  expect(id).not.toBeNull();
  return id ?? -1;
}

describe('clicks', () => {
  test('two begin a vessel with a line, a name and a colour, in one step', async () => {
    await begun();
    expect(document_.value.vessels).toMatchObject([
      { name: 'Vessel 1', line: 0, clicks: [A, B], doubt: null },
    ]);
    expect(undoWords.value).toBe('begin a vessel');
    undo();
    expect(document_.value.vessels).toEqual([]);
    expect(undoWords.value).toBeNull();
  });

  test('are added, inserted, moved and removed, and the line follows', async () => {
    const id = await begun();
    await addClick(tracing, id, C);
    expect(clicks()).toEqual([A, B, C]);
    await insertClick(tracing, id, 1, [5, 0, 0]);
    expect(clicks()).toEqual([A, [5, 0, 0], B, C]);
    await moveClick(tracing, id, 2, [11, 0, 0]);
    expect(clicks()).toEqual([A, [5, 0, 0], [11, 0, 0], C]);
    await removeClick(tracing, id, 0);
    expect(clicks()).toEqual([[5, 0, 0], [11, 0, 0], C]);
    expect(linePoints()).toEqual(clicks());
  });

  test('a vessel with one click left goes', async () => {
    const id = await begun();
    await removeClick(tracing, id, 1);
    expect(document_.value.vessels).toEqual([]);
    undo();
    expect(clicks()).toEqual([A, B]);
  });

  test('all vessels that were clicked are traced together, beside the others', async () => {
    beginStudy(reportOf([{ line: 70, name: 'from a file' }]));
    tracing.branches = ['touches bone'];
    await addBranches(tracing, A);
    await begun();
    await begun(C, A);
    expect(tracing.traces.at(-1)).toMatchObject({
      vessels: [
        [A, B],
        [C, A],
      ],
      beside: [70],
      bridge: false,
    });
  });

  test('that come while one is traced take their turn', async () => {
    const id = await begun();
    let open = () => {};
    tracing.gate = new Promise((resolve) => {
      open = resolve;
    });
    const both = [addClick(tracing, id, C), addClick(tracing, id, A)];
    expect(waiting.value).toBe(2);
    open();
    expect(await Promise.all(both)).toEqual([true, true]);
    expect(clicks()).toEqual([A, B, C, A]);
    expect(waiting.value).toBe(0);
  });
});

describe('a click that is refused', () => {
  test('changes nothing, and the cross-hair jumps to the weakest place', async () => {
    const id = await begun();
    const before = document_.value;
    expect(await addClick(tracing, id, AIR)).toBe(false);
    expect(document_.value).toBe(before);
    expect(undoWords.value).toBe('begin a vessel');
    expect(store.problem.value?.message).toContain('no lumen');
    expect(store.crossHair.value).toMatchObject({ point: AIR, value: 35 });
    expect(refusal.value?.failure).toBe(store.problem.value);
  });

  test('is taken where the gap is bridged, in one step', async () => {
    const id = await begun();
    await addClick(tracing, id, AIR);
    refusal.value?.bridge?.();
    await expect.poll(() => clicks()).toEqual([A, B, AIR]);
    expect(document_.value.bridge).toBe(true);
    expect(store.problem.value).toBeNull();
    undo();
    expect(document_.value.bridge).toBe(false);
    expect(clicks()).toEqual([A, B]);
  });

  test('drops those that wait behind it', async () => {
    const id = await begun();
    const both = [addClick(tracing, id, AIR), addClick(tracing, id, C)];
    expect(await Promise.all(both)).toEqual([false, false]);
    expect(clicks()).toEqual([A, B]);
    expect(await addClick(tracing, id, C)).toBe(true);
  });

  test('at once where gaps are bridged already offers no bridge', async () => {
    await setBridge(tracing, true);
    tracing.trace = () => Promise.reject(new Failure('tracing', 'x', 'y', 'z', '', { place: AIR }));
    await beginVessel(tracing, [A, B]);
    expect(refusal.value?.bridge).toBeNull();
  });
});

test('an edit that was stopped, or whose study was closed, does nothing', async () => {
  const id = await begun();
  const stopped = addClick(tracing, id, C);
  dropEdits();
  expect(await stopped).toBe(false);
  const late = addClick(tracing, id, C);
  beginStudy(null);
  expect(await late).toBe(false);
  expect(document_.value.vessels).toEqual([]);
  expect(store.problem.value).toBeNull();
});

test('what is changed while a vessel is traced stays', async () => {
  const id = await begun();
  let open = () => {};
  tracing.gate = new Promise((resolve) => {
    open = resolve;
  });
  const adding = addClick(tracing, id, C);
  const { change } = await import('../src/edit/history');
  change('mark', { ...document_.value, rulers: [{ from: A, to: B }] });
  open();
  await adding;
  expect(document_.value.rulers).toHaveLength(1);
  expect(clicks()).toEqual([A, B, C]);
});

describe('stoppers', () => {
  test('are set, moved and removed, and the vessels traced around them', async () => {
    await begun();
    await addStopper(tracing, C);
    expect(tracing.traces.at(-1)?.stoppers).toEqual([{ center: C, radius: 3 }]);
    await moveStopper(tracing, 0, A);
    expect(document_.value.stoppers).toEqual([{ center: A, radius: 3 }]);
    await removeStopper(tracing, 0);
    expect(tracing.traces.at(-1)?.stoppers).toEqual([]);
  });
});

describe('branches from a seed', () => {
  test('are added in one step; doubtful ones are accepted or left out', async () => {
    tracing.branches = [null, 'touches bone', 'is short'];
    await addBranches(tracing, A);
    expect(names()).toEqual(['Branch 1', 'Branch 2', 'Branch 3']);
    expect(document_.value.vessels.map((vessel) => vessel.doubt)).toEqual([null, 'touches bone', 'is short']);
    const [, second, third] = document_.value.vessels.map((vessel) => vessel.id);
    await accept([second ?? -1]);
    await leaveOut([second ?? -1, third ?? -1]);
    expect(names()).toEqual(['Branch 1', 'Branch 2']);
    undo();
    undo();
    undo();
    expect(document_.value.vessels).toEqual([]);
  });
});

test('a mask adds its vessels and says what was odd', async () => {
  await addMask(tracing, []);
  expect(names()).toEqual(['aorta', 'Mask 1']);
  expect(store.notes.value).toEqual(['the mask has holes']);
});

describe('whole vessels', () => {
  test('are renamed, coloured, hidden and deleted', async () => {
    const id = await begun();
    await rename(id, 'SMA');
    await recolor(id, '#56b4e9');
    await hide(id, true);
    expect(document_.value.vessels).toMatchObject([{ name: 'SMA', color: '#56b4e9', isHidden: true }]);
    await remove([id]);
    expect(document_.value.vessels).toEqual([]);
  });

  test('a change to what is there already makes no step', async () => {
    const id = await begun();
    await rename(id, 'Vessel 1');
    await hide(id, false);
    expect(undoWords.value).toBe('begin a vessel');
  });

  test('are cut in two, the first of which keeps its id', async () => {
    const id = await begun();
    await cut(tracing, id, 4);
    expect(document_.value.vessels).toMatchObject([
      { id, name: 'Vessel 1', clicks: null },
      { name: 'Vessel 1 part 1', clicks: null },
    ]);
    expect(linePoints(0)).toEqual([A, [4, 0, 0]]);
    expect(linePoints(1)).toEqual([[4, 0, 0], B]);
  });

  test('are joined to one with the name of the first', async () => {
    const [first, second] = [await begun(), await begun(B, C)];
    await join(tracing, second, first);
    expect(document_.value.vessels).toMatchObject([{ id: second, name: 'Vessel 2', clicks: null }]);
    expect(linePoints()).toEqual([B, C, A, B]);
  });
});

test('vessels of a file come as one step', async () => {
  await begun();
  await addLoaded(reportOf([{ line: 5, name: 'left' }]).vessels ?? []);
  expect(names()).toEqual(['Vessel 1', 'left']);
  undo();
  expect(names()).toEqual(['Vessel 1']);
});

test('a file has all vessels but the doubtful ones', async () => {
  tracing.branches = [null, 'touches bone', null];
  await addBranches(tracing, A);
  await hide(document_.value.vessels[2]?.id ?? -1, true);
  const file = await centerlineFile(tracing, 'vtp');
  expect(await file.text()).toBe('vtp: Branch 1,Branch 3');
});

test('thirty steps are undone and done again, to the letter', async () => {
  const id = await begun();
  const states = [document_.value];
  for (let n = 0; n < 29; n++) {
    await addClick(tracing, id, [n, 1, 0]);
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
