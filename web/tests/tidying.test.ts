/** Cleaning a tree and reviewing doubtful branches, with an engine that answers at once. */
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { Asked, DocumentVessel, EditRequest, LineFacts, Started } from '../src/core/messages';
import { answerDoubt, countedDoubts, placeOfDoubt, reasonOf, showDoubt, stepDoubt } from '../src/edit/doubts';
import { hideAll, keepPart, removeMarked, rename } from '../src/edit/vessels';
import { EMPTY } from '../src/state/document';
import { editQueue } from '../src/state/edit-queue';
import { begin, document_, undo } from '../src/state/history';
import { isListOpen } from '../src/state/panels';
import { tree } from '../src/state/shown';
import { pickedVessel, started } from '../src/state/store';
import {
  followFacts,
  isTreeShown,
  listedVessels,
  marked,
  markNone,
  reachOf,
  shorterThan,
  suggestedNameOf,
  thinnerThan,
  treeChosen,
  unconnected,
  veinsAndHeart,
} from '../src/state/tidying';
import { chosenDoubt } from '../src/state/tool';
import { connect } from '../src/worker/engine';

const vessel = (id: number, doubt: string | null = null): DocumentVessel => ({
  id,
  line: id + 10,
  name: '',
  color: '#fff',
  isHidden: false,
  clicks: null,
  doubt,
  contours: [],
});
/** Sure vessels: a trunk with two branches, and two separate vessels, one of them of unknown radius. */
const SURE = [1, 2, 3, 4, 5].map((id) => vessel(id));
const DOUBTFUL = [6, 7, 8].map((id) => vessel(id, `reason ${id}`));
const PLAIN = {
  length: 1,
  calibre: null,
  part: 0,
  parent: null,
  suggested_name: null,
  is_vein_or_heart: false,
};
const FACTS: readonly LineFacts[] = [
  { ...PLAIN, line: 11, length: 100, calibre: 20, suggested_name: 'Aorta' },
  { ...PLAIN, line: 12, length: 30, calibre: 6, parent: 13 },
  { ...PLAIN, line: 13, length: 9, calibre: 1.5, parent: 11 },
  { ...PLAIN, line: 14, length: 40, calibre: 1.9, part: 1, is_vein_or_heart: true },
  { ...PLAIN, line: 15, length: 5, part: 2, parent: 11, is_vein_or_heart: true },
];

const factsAmong = (vessels: readonly DocumentVessel[]): readonly LineFacts[] => {
  const told = new Map(FACTS.map((one) => [one.line, one]));
  const sure = vessels.filter(({ doubt }) => doubt === null);
  return sure.map(({ line }) => told.get(line) ?? { ...PLAIN, line, part: 9 });
};

const asked: string[] = [];

function edited({ document, edit }: EditRequest): object {
  const { kind, ids = [] } = edit as { kind: string; ids?: readonly number[] };
  const vessels =
    kind === 'accept'
      ? document.vessels.map((one) => (ids.includes(one.id) ? { ...one, doubt: null } : one))
      : document.vessels.filter((one) => !ids.includes(one.id));
  const after = {
    document: { ...document, vessels },
    words: kind,
    added: [],
    without_marks: [],
    notes: [],
    doubts: [],
    told: null,
  };
  return { edited: after, report: null, lines: [], facts: factsAmong(vessels), pick: null };
}

const engine = {
  ask: async (name: string, message: unknown) => {
    asked.push(name);
    const told = new Map(FACTS.map((one) => [one.line, one]));
    return name === 'edit'
      ? edited(message as EditRequest)
      : (message as { lines: readonly number[] }).lines.map(
          (line) => told.get(line) ?? { line, length: 1, part: 9, parent: null },
        );
  },
} as unknown as Asked;
connect(engine);

const ids = () => document_.value.vessels.map((one) => one.id);
let end = () => {};

beforeEach(async () => {
  editQueue.drop();
  begin({ ...EMPTY, vessels: [...SURE, ...DOUBTFUL] });
  tree.value = SURE;
  isListOpen.value = true;
  end = followFacts();
  await vi.waitFor(() => expect(unconnected.value.length).toBe(0));
  await Promise.resolve();
});

afterEach(() => {
  end();
  markNone();
  chosenDoubt.value = null;
  pickedVessel.value = null;
  isListOpen.value = false;
  begin(EMPTY);
});

test('short and thin vessels are marked while the limits change, and are removed in one step', async () => {
  expect(marked.value.size).toBe(0);
  shorterThan.value = 10;
  expect([...marked.value], 'vessel 3 is short, but connects vessel 2 to the trunk').toEqual([5]);
  shorterThan.value = 35;
  expect([...marked.value], 'both are short').toEqual([2, 3, 5]);
  shorterThan.value = 5;
  thinnerThan.value = 2;
  expect([...marked.value], 'a limit itself is long enough; a radius that is not known is not thin').toEqual([
    4,
  ]);
  shorterThan.value = 10;
  thinnerThan.value = 0;
  expect([...marked.value]).toEqual([5]);
  thinnerThan.value = 2;
  expect([...marked.value]).toEqual([4, 5]);
  expect(await removeMarked()).toBe(true);
  expect(ids()).toEqual([1, 2, 3, 6, 7, 8]);
  expect([shorterThan.value, thinnerThan.value]).toEqual([0, 0]);
  undo();
  expect(ids()).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
});

test('a limit slider covers most vessels, but not more than its usual range', () => {
  const to = (last: number) => Array.from({ length: last + 1 }, (_, n) => n);
  expect(reachOf(to(40), 60)).toBe(38);
  expect(reachOf(to(100), 60), 'a pixel of a slider to 95 would be too much').toBe(60);
  expect(reachOf(to(300), 60), 'a slider to 60 would leave most vessels').toBe(150);
  expect(reachOf([5], 60)).toBe(5);
  expect(reachOf([], 60), 'nothing is known yet').toBe(0);
});

test('only vessels connected to the picked one are kept; doubtful branches stay for review', async () => {
  expect(unconnected.value, 'none is picked').toEqual([]);
  pickedVessel.value = 3;
  expect(unconnected.value).toEqual([1, 2, 3, 5]);
  pickedVessel.value = 1;
  expect(unconnected.value).toEqual([4, 5]);
  await keepPart();
  expect(ids()).toEqual([1, 2, 3, 6, 7, 8]);
});

test('if vessels join, the list is a tree unless the user wants none: branches under their parents, the widest first', () => {
  const rows = () => listedVessels.value.map(({ vessel, depth }) => [vessel.id, depth]);
  treeChosen.value = false;
  expect(rows()).toEqual([1, 2, 3, 4, 5].map((id) => [id, 0]));
  treeChosen.value = null;
  expect(isTreeShown.value).toBe(true);
  expect(rows()).toEqual([
    [1, 0],
    [3, 1],
    [2, 2],
    [5, 1],
    [4, 0],
  ]);
  begin({ ...EMPTY, vessels: [SURE[0], SURE[3]] as DocumentVessel[] });
  expect(isTreeShown.value, 'two that do not join').toBe(false);
  treeChosen.value = true;
  expect(isTreeShown.value).toBe(true);
  begin({ ...EMPTY, vessels: [SURE[0]] as DocumentVessel[] });
  expect(isTreeShown.value, 'one vessel is no tree').toBe(false);
  treeChosen.value = null;
});

test('doubtful branches are counted by their short reasons, the most frequent first', () => {
  const doubts = [
    { words: 'it is short', short: 'short' },
    { words: 'it is bright on most sides: bone?', short: 'beside bone' },
  ];
  started.value = { doubts } as unknown as Started;
  const [bone, short, other] = ['it is bright on most sides: bone?', 'it is short', 'as a session says'];
  const all = [bone, short, short, other].map((doubt, n) => vessel(n, doubt ?? null));
  expect(countedDoubts(all)).toBe('4 doubtful: 2 short, 1 beside bone, 1 as a session says');
  expect(all.map(reasonOf)).toEqual(['beside bone', 'short', 'short', 'as a session says']);
  started.value = null;
});

test('doubtful branches are shown in turn, and after the last comes the first', async () => {
  expect(placeOfDoubt()).toEqual([-1, 3]);
  const seen = [1, 1, 1, 1, -1, -1].map((by) => {
    stepDoubt(by as 1 | -1);
    return chosenDoubt.value;
  });
  expect(seen).toEqual([6, 7, 8, 6, 8, 7]);
  expect(placeOfDoubt()).toEqual([1, 3]);
});

test('after each answer the next doubtful branch is shown, after the last one none', async () => {
  await showDoubt(DOUBTFUL[1] as DocumentVessel);
  await answerDoubt('accept');
  expect(chosenDoubt.value).toBe(8);
  await answerDoubt('leave out');
  expect(chosenDoubt.value, 'after the last comes the first').toBe(6);
  await answerDoubt('leave out');
  expect(chosenDoubt.value).toBeNull();
  expect(document_.value.vessels.map(({ id, doubt }) => [id, doubt])).toEqual(
    [1, 2, 3, 4, 5, 7].map((id) => [id, null]),
  );
  await answerDoubt('accept');
  expect(ids()).toEqual([1, 2, 3, 4, 5, 7]);
});

test('a suggested name names nothing until the user takes it', async () => {
  const first = () => document_.value.vessels[0] as DocumentVessel;
  expect(suggestedNameOf(first())).toBe('Aorta');
  expect(first().name).toBe('');
  await rename(1, 'Vessel 1');
  expect(suggestedNameOf(first()), 'a number is no name').toBe('Aorta');
  await rename(1, 'graft');
  expect(suggestedNameOf(first()), 'a name that the user gave').toBe(null);
});

test('veins and heart are hidden and shown in one step each, except those that the user named', async () => {
  const hidden = () => document_.value.vessels.filter((one) => one.isHidden).map((one) => one.id);
  expect(veinsAndHeart.value.map((one) => one.id)).toEqual([4, 5]);
  await hideAll(veinsAndHeart.value, true);
  expect(hidden()).toEqual([4, 5]);
  undo();
  expect(hidden()).toEqual([]);
  await hideAll(veinsAndHeart.value, true);
  await hideAll(veinsAndHeart.value, false);
  expect(hidden()).toEqual([]);
  await rename(4, 'Azygos');
  expect(veinsAndHeart.value.map((one) => one.id)).toEqual([5]);
});
