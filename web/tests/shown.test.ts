import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import type { Pair, Report } from '../src/core/messages';
import { hide, remove } from '../src/edit/vessels';
import { changed } from '../src/state/changes';
import { change, document_, redo, undo } from '../src/state/history';
import { contents, followLines, forgetLines, lengthOf } from '../src/state/lines';
import { beginStudy, followDocument, listedLines, pickedId, successor, tree } from '../src/state/shown';
import * as store from '../src/state/store';
import { active } from '../src/state/tool';
import { connect } from '../src/worker/engine';
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
  connect(tracing);
  end = followDocument();
  store.pickedPlace.value = 0;
});

afterEach(() => {
  end();
  store.report.value = null;
  beginStudy(null);
});

test('the vessels with which a study is opened are displayed, and are no undo step', async () => {
  open(1, 2);
  await idle();
  expect(tracing.shown).toEqual([]);
  expect(tree.value.map((vessel) => vessel.line)).toEqual([1, 2]);
});

test('each change of the tree is displayed, also by undo and redo; other changes cause no request', async () => {
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

test('volume, views and cross-hair stay the same', async () => {
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

test('if the vessel of the cross-hair is deleted, all views move to the vessel picked next', async () => {
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

test('a suggested window follows the vessels; a chosen window stays', async () => {
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

test('while a tree is requested, only the latest further change is remembered', async () => {
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

test('a tree of a closed study is ignored', async () => {
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

test('hidden vessels affect measurements, doubtful ones do not', async () => {
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

describe('the picked vessel', () => {
  test('stays picked if others are deleted', async () => {
    open(1, 2, 3);
    store.pickedVessel.value = 2;
    store.pickedPlace.value = 7;
    await remove([1]);
    await idle();
    expect(store.pickedVessel.value).toBe(1);
    expect(pickedId()).toBe(3);
    expect(store.pickedPlace.value).toBe(7);
  });

  test('is the next vessel, at half its length, if it is deleted', async () => {
    open(1, 2, 3);
    store.pickedVessel.value = 1;
    await hide(2, true);
    await idle();
    expect(pickedId()).toBe(3);
    expect(store.pickedPlace.value).toBe(5);
  });

  test('is none if all are deleted, and the cross-hair lies on none', async () => {
    open(1);
    store.crossHair.value = { point: [1, 2, 3], value: 4, vessel: 0, arcLength: 5 };
    await remove([1]);
    await idle();
    expect(store.pickedVessel.value).toBeNull();
    expect(store.crossHair.value).toMatchObject({ point: [1, 2, 3], vessel: null, arcLength: null });
  });

  test('is the last vessel if none follows, but a vessel being drawn comes first', () => {
    open(1, 2, 3);
    const all = tree.value;
    expect(successor(all, 2, all.slice(0, 2))).toBe(1);
    active.value = 1;
    expect(successor(all, 2, all)).toBe(0);
  });
});

test('the content of a line is requested once, and contains its length', async () => {
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
    by_hand: null,
  });
  const stop = followLines();
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
