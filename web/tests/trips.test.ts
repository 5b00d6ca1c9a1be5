/** A click while tracing needs only one request to the worker. */
import { afterEach, beforeEach, expect, test } from 'vitest';
import type { Vector } from '../src/core/messages';
import { endVessel, setPoint, takeWhole } from '../src/edit/pointing';
import { followPointer, followWhole } from '../src/edit/previews';
import { hide } from '../src/edit/vessels';
import { answered, editQueue } from '../src/state/edit-queue';
import { document_, undo } from '../src/state/history';
import { contents, followLines, forgetLines } from '../src/state/lines';
import { isListOpen } from '../src/state/panels';
import { beginStudy, followDocument, pickedId, tree } from '../src/state/shown';
import * as store from '../src/state/store';
import { factsOf, followFacts } from '../src/state/tidying';
import { tool } from '../src/state/tool';
import { connect } from '../src/worker/engine';
import { documentOf, FakeTracing, reportOf } from './fake-tracing';

const [A, B, C]: Vector[] = [
  [0, 0, 0],
  [10, 0, 0],
  [20, 5, 0],
];

let tracing: FakeTracing;
let ends: (() => void)[];
const idle = () => new Promise((resolve) => setTimeout(resolve, 5));

/** Waits until all work is done; returns the requests since the last call. */
async function trips(): Promise<readonly string[]> {
  await idle();
  return tracing.trips.splice(0);
}

beforeEach(() => {
  tracing = new FakeTracing();
  connect(tracing);
  forgetLines();
  store.report.value = reportOf([]);
  store.pickedVessel.value = null;
  beginStudy(documentOf());
  isListOpen.value = true;
  tool.value = 'trace';
  endVessel();
  const followers = [followDocument, followLines, followFacts, followPointer, followWhole];
  ends = followers.map((follow) => follow());
});

afterEach(() => {
  for (const end of ends) {
    end();
  }
  isListOpen.value = false;
  tool.value = 'look';
  store.report.value = null;
  beginStudy(null);
});

test('each click takes one request, whose answer contains all that the page shows', async () => {
  expect((await setPoint(A as Vector))?.value).toBe(300);
  expect(await trips()).toEqual(['first_click']);
  for (const point of [B, C] as Vector[]) {
    await setPoint(point);
    expect(await trips()).toEqual(['edit']);
    const [vessel] = document_.value.vessels;
    expect(tree.value).toEqual(document_.value.vessels);
    expect(contents.value.get(vessel?.line ?? -1)?.points.at(-1)).toEqual(point);
    expect(vessel && factsOf(vessel)?.length).toBe(10);
    expect(store.report.value?.vessels).toHaveLength(1);
    expect(pickedId()).toBe(vessel?.id);
  }
});

test('the answer to a first click contains the whole vessel, which is picked once it is added', async () => {
  await setPoint(A as Vector);
  takeWhole();
  expect(await trips()).toEqual(['first_click', 'edit']);
});

test('undo and changes by the page itself are displayed by a separate request', async () => {
  await setPoint(A as Vector);
  await setPoint(B as Vector);
  await trips();
  await hide(document_.value.vessels[0]?.id ?? -1, true);
  expect(await trips()).toEqual(['show']);
  undo();
  expect(await trips()).toEqual(['show']);
  undo();
  expect(await trips()).toEqual(['show']);
  expect(tree.value).toEqual([]);
});

test('after an edit that was dropped while the engine worked, the document is displayed again', async () => {
  await setPoint(A as Vector);
  let open = () => {};
  tracing.gate = new Promise((resolve) => {
    open = resolve;
  });
  const setting = setPoint(B as Vector);
  await idle();
  editQueue.drop();
  open();
  await setting;
  expect(await trips()).toEqual(['first_click', 'edit', 'show', 'whole_vessel']);
  expect(answered.value?.edited.document.vessels).toHaveLength(1);
  expect([document_.value.vessels, tree.value]).toEqual([[], []]);
});
