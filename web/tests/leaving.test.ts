/** The user is asked before unsaved work is lost. */
import { beforeEach, expect, test } from 'vitest';
import { EMPTY } from '../src/state/document';
import { begin, change, document_, markSaved, undo } from '../src/state/history';
import { leaving } from '../src/state/questions';
import { guardLeaving, leave, lossWords } from '../src/study/unsaved';
import { withLines } from './fake-tracing';

const more = (...lines: number[]) => withLines(document_.value, ...lines);
let gone = 0;
const go = async () => {
  gone += 1;
};

beforeEach(() => {
  begin(EMPTY);
  leaving.value = null;
  gone = 0;
});

test('nothing is asked if nothing was edited, or all edits are undone', async () => {
  await leave(go);
  change('add', more(1));
  undo();
  await leave(go);
  expect([gone, leaving.value]).toEqual([2, null]);
});

test('vessels that were not saved are counted', async () => {
  begin(more(7));
  change('add', more(8));
  await leave(go);
  expect([gone, leaving.value?.words]).toEqual([0, 'Discard 1 vessel that was not saved?']);
  change('add', more(9));
  await leave(go);
  expect(leaving.value?.words).toBe('Discard 2 vessels that were not saved?');
  await leaving.value?.go();
  expect(gone).toBe(1);
});

test('the question mentions other changes too, such as those since the last save', async () => {
  change('add', more(8));
  markSaved(document_.value);
  await leave(go);
  expect(gone).toBe(1);
  change('bridge', { ...document_.value, bridge: true });
  await leave(go);
  expect([gone, leaving.value?.words]).toEqual([1, 'Discard changes that were not saved?']);
  expect(lossWords(EMPTY, document_.value)).toBe('Discard changes that were not saved?');
});

test('the browser asks before the page closes only if something is not saved', () => {
  const page = new EventTarget();
  guardLeaving(page as Window);
  const isAsked = () => {
    const event = new Event('beforeunload', { cancelable: true });
    page.dispatchEvent(event);
    return event.defaultPrevented;
  };
  expect(isAsked()).toBe(false);
  change('add', more(1));
  expect(isAsked()).toBe(true);
  markSaved(document_.value);
  expect(isAsked()).toBe(false);
});
