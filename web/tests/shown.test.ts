import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import type { Pair, Report } from '../src/core/messages';
import { contents, followLines, forgetLines, lengthOf } from '../src/edit/lines';
import { beginStudy, followDocument, listedLines, pickedId, successor, tree } from '../src/edit/shown';
import { hide, remove } from '../src/edit/vessels';
import { changed } from '../src/state/changes';
import { change, document_, redo, undo } from '../src/state/history';
import * as store from '../src/state/store';
import { active } from '../src/state/tool';
import { documentOf, FakeTracing, reportOf, withLines } from './fake-tracing';

let tracing: FakeTracing;
let end: () => void;

const shownLines = () => tracing.shown.map((lines) => lines.map(({ line }) => line));
const add = (...lines: number[]) => change('add', withLines(document_.value, ...lines));

const idle = () => new Promise((resolve) => setTimeout(resolve, 5));

function open(...lines: number[]): void {
  store.report.value = reportOf(lines.map((line) => ({ line, name: `n${line}` })));
  beginStudy(documentOf(...lines));
  store.pickedVessel.value = lines.length > 0 ? 0 : null;
}

beforeEach(() => {
  tracing = new FakeTracing();
  end = followDocument(tracing);
  store.pickedPlace.value = 0;
});

afterEach(() => {
  end();
  store.report.value = null;
  beginStudy(null);
});

test('what a study is opened with is shown already, and no step', async () => {
  open(1, 2);
  await idle();
  expect(tracing.shown).toEqual([]);
  expect(tree.value.map((vessel) => vessel.line)).toEqual([1, 2]);
});

test('each change is shown, undo and redo too; what does not change the tree is not', async () => {
  open(1);
  add(2);
  await idle();
  undo();
  await idle();
  redo();
  await idle();
  change('bridge', { ...document_.value, bridge: true });
  await idle();
  expect(shownLines()).toEqual([[1, 2], [1], [1, 2]]);
});

test('the volume, its views and the cross-hair stay', async () => {
  open(1);
  const { volume } = store.report.value ?? {};
  store.crossHair.value = { point: [1, 2, 3], value: 4, vessel: 0, arcLength: 5 };
  const [camera, window] = [store.camera.value, store.window_.value];
  add(2);
  await idle();
  expect(store.report.value?.vessels).toHaveLength(2);
  expect(store.report.value?.volume).toBe(volume);
  expect(store.crossHair.value).toEqual({ point: [1, 2, 3], value: 4, vessel: 0, arcLength: 5 });
  expect([store.camera.value, store.window_.value]).toEqual([camera, window]);
});

test('where the vessel of the cross-hair is deleted, all views go on to the one that is picked then', async () => {
  open(1, 2);
  store.crossHair.value = { point: [1, 2, 3], value: 4, vessel: 0, arcLength: 5 };
  const [first] = document_.value.vessels;
  change('delete', { ...document_.value, vessels: document_.value.vessels.filter((one) => one !== first) });
  await idle();
  expect(store.pickedVessel.value).toBe(0);
  const at = store.pickedPlace.value;
  expect(at).toBe((store.report.value?.vessels?.[0]?.length ?? 0) / 2);
  expect(store.crossHair.value).toEqual({ point: [0, 0, at], value: 7, vessel: 0, arcLength: at });
});

test('the window that the data suggest follows the vessels, one that was chosen stays', async () => {
  const told = (main: Pair): Report => ({
    ...reportOf([{ line: 1, name: 'n1' }]),
    windows: { main, contexts: {}, presets: [], is_hounsfield: false, may_hold_stents: false },
  });
  for (const [chosen, expected] of [
    [
      [723, 604],
      [1210, 2379],
    ],
    [
      [300, 900],
      [300, 900],
    ],
  ] as [Pair, Pair][]) {
    open(1);
    store.report.value = told([723, 604]);
    store.window_.value = chosen;
    tracing.windows = told([1210, 2379]).windows;
    add(2);
    await idle();
    expect(store.window_.value).toEqual(expected);
  }
});

test('while a tree is made others do not pile up: the latest follows', async () => {
  open();
  let go = () => {};
  tracing.gate = new Promise((resolve) => {
    go = resolve;
  });
  add(1);
  await idle();
  add(2);
  add(3);
  add(4);
  go();
  await idle();
  expect(shownLines()).toEqual([[1], [1, 2, 3, 4]]);
});

test('a tree of a study that was closed is not taken', async () => {
  open(1);
  let go = () => {};
  tracing.gate = new Promise((resolve) => {
    go = resolve;
  });
  add(2);
  store.report.value = reportOf([{ line: 9, name: 'other' }]);
  beginStudy(documentOf(9));
  go();
  await idle();
  expect(store.report.value.vessels).toHaveLength(1);
  expect(tree.value.map((vessel) => vessel.line)).toEqual([9]);
});

test('what vessels are measured among counts hidden ones too, and no doubtful ones', async () => {
  open(1, 2);
  expect(listedLines.value).toBe('1,2');
  await hide(2, true);
  await idle();
  expect([listedLines.value, tree.value.length]).toEqual(['1,2', 1]);
  // The hidden vessel's line changed, so the visible one is measured again.
  change('edit', changed(document_.value, 2, { line: 7 }));
  await idle();
  expect([listedLines.value, tree.value.length]).toEqual(['1,7', 1]);
  change('doubt', changed(document_.value, 2, { doubt: 'short' }));
  await idle();
  expect(listedLines.value).toBe('1');
});

describe('the vessel that is picked', () => {
  test('stays the same one where others go', async () => {
    open(1, 2, 3);
    store.pickedVessel.value = 2;
    store.pickedPlace.value = 7;
    await remove(tracing, [1]);
    await idle();
    expect(store.pickedVessel.value).toBe(1);
    expect(pickedId()).toBe(3);
    expect(store.pickedPlace.value).toBe(7);
  });

  test('is the next one where it goes, and shows its middle', async () => {
    open(1, 2, 3);
    store.pickedVessel.value = 1;
    await hide(2, true);
    await idle();
    expect(pickedId()).toBe(3);
    expect(store.pickedPlace.value).toBe(5);
  });

  test('is none where all go, and the cross-hair is on none', async () => {
    open(1);
    store.crossHair.value = { point: [1, 2, 3], value: 4, vessel: 0, arcLength: 5 };
    await remove(tracing, [1]);
    await idle();
    expect(store.pickedVessel.value).toBeNull();
    expect(store.crossHair.value).toMatchObject({ point: [1, 2, 3], vessel: null, arcLength: null });
  });

  test('is the last one where none follows, and the one that is drawn first of all', () => {
    open(1, 2, 3);
    const all = tree.value;
    expect(successor(all, 2, all.slice(0, 2))).toBe(1);
    active.value = 1;
    expect(successor(all, 2, all)).toBe(0);
  });
});

test('the content of lines is asked for once, and gives their length', async () => {
  forgetLines();
  const line = await tracing.add_line({
    points: [
      [0, 0, 0],
      [3, 4, 0],
      [3, 4, 2],
    ],
    radius: null,
    confidence: null,
    bridged: null,
  });
  const stop = followLines(tracing);
  open(line);
  await idle();
  expect(lengthOf(line)).toBe(7);
  const loaded = contents.value;
  await hide(1, true);
  undo();
  await idle();
  expect(contents.value).toBe(loaded);
  stop();
});
