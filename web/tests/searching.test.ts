/** Tests of the search for vessels: its seeds, clicks during the search, and the first view of the result. */
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { Camera, DocumentVessel, Vector } from '../src/core/messages';
import { findVessels } from '../src/edit/branches';
import { branchesFromHere } from '../src/edit/performing';
import { setPoint } from '../src/edit/pointing';
import { EMPTY } from '../src/state/document';
import { first } from '../src/state/drawing';
import { editQueue } from '../src/state/edit-queue';
import { begin, document_ } from '../src/state/history';
import { message } from '../src/state/message';
import { toPick } from '../src/state/shown';
import * as store from '../src/state/store';
import { tool } from '../src/state/tool';
import { connect } from '../src/worker/engine';
import { FakeTracing, withLines } from './fake-tracing';

const OPENED: Vector = [0, 0, 0];
const CHOSEN: Vector = [3, 4, 5];
const hairAt = (point: Vector) => ({ point, value: null, vessel: null, arcLength: null });

let tracing = new FakeTracing();
const kinds = () => tracing.edits.map(({ edit }) => edit.kind);

beforeEach(() => {
  vi.stubGlobal('window', Object.assign(globalThis, { matchMedia: () => ({ matches: true }) }));
  tracing = new FakeTracing();
  connect(tracing);
  editQueue.drop();
  begin(EMPTY);
  store.firstPlace.value = OPENED;
  store.crossHair.value = hairAt(OPENED);
});

afterEach(() => {
  tool.value = 'look';
  store.camera.value = null;
  toPick.value = null;
  first.value = null;
  message.value = null;
});

test('if the user has not placed the cross-hair, a click chooses where a tree begins', async () => {
  branchesFromHere();
  expect([tool.value, kinds()]).toEqual(['seed', []]);
  await setPoint(CHOSEN);
  expect(tracing.edits[0]?.edit).toEqual({ kind: 'add_branches', seed: CHOSEN });
  expect(tool.value).toBe('look');
  store.crossHair.value = hairAt(CHOSEN);
  branchesFromHere();
  await vi.waitFor(() => expect(kinds()).toEqual(['add_branches', 'add_branches']));
  expect(tool.value, 'the cross-hair stands where the reader put it').toBe('look');
});

test('a second press of the key cancels the choice of a seed', () => {
  branchesFromHere();
  branchesFromHere();
  expect([tool.value, kinds()]).toEqual(['look', []]);
});

test('clicks during a search for vessels set no points, and the page says so', async () => {
  let open = () => {};
  tracing.gate = new Promise((resolve) => {
    open = resolve;
  });
  const finding = findVessels();
  await vi.waitFor(() => expect(editQueue.isSearching).toBe(true));
  tool.value = 'trace';
  await setPoint(CHOSEN);
  expect(first.value).toBeNull();
  expect(message.value).toContain('No point was set');
  open();
  await finding;
  expect(editQueue.isSearching).toBe(false);
  await setPoint(CHOSEN);
  expect(first.value).toEqual(CHOSEN);
});

test('of the first vessels found, the root of the main tree is picked and shown best, however wide others are; later searches do not change the view', async () => {
  const camera = { size: [10, 10], center: [0, 0, 0] } as unknown as Camera;
  const best = { ...camera, center: [7, 7, 7] } as unknown as Camera;
  const asked: unknown[] = [];
  Object.assign(tracing, {
    edit: async () => ({
      edited: {
        document: withLines({ ...document_.value }, 20, 21, 22),
        words: 'find',
        added: [1, 2, 3],
        without_marks: [],
        notes: [],
        doubts: [],
        told: null,
      },
      report: null,
      lines: [],
      facts: [20, 21, 22].map((line, n) => ({
        line,
        length: 100 - n,
        calibre: [3, 24, 7][n],
        part: 0,
        parent: null,
      })),
      pick: null,
    }),
    best_view: async (message: { line: number }) => {
      asked.push(message.line);
      return best;
    },
  });
  store.camera.value = camera;
  await findVessels();
  expect(asked).toEqual([20]);
  expect(toPick.value).toBe((document_.value.vessels[0] as DocumentVessel).id);
  expect(store.camera.value?.center).toEqual([7, 7, 7]);
  await findVessels();
  expect(asked, 'there were vessels before').toEqual([20]);
});
