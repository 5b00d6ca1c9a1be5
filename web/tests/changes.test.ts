import { describe, expect, test } from 'vitest';
import {
  afterEdit,
  changed,
  DOUBTFUL,
  doubtful,
  nameOf,
  nextColor,
  PALETTE,
  shownVessels,
} from '../src/state/changes';
import { type Document, EMPTY, NO_MARKS } from '../src/state/document';
import { documentOf } from './fake-tracing';

const THREE: Document = { ...EMPTY, ...documentOf(11, 12, 13), marks: { 1: NO_MARKS, 2: NO_MARKS } };
const [first, second, third] = THREE.vessels;

const edited = (document: Document, ...lost: number[]) => ({
  document: structuredClone(document),
  words: 'x',
  added: [],
  without_marks: lost,
  notes: [],
  doubts: [],
  told: null,
});

test('a vessel without a name is named by its id', () => {
  const document = changed(THREE, 2, { name: '' });
  expect(document.vessels.map(nameOf)).toEqual(['n11', 'vessel 2', 'n13']);
});

test('the next colour is the first of those that the fewest vessels have', () => {
  const colors = PALETTE.map(([color]) => color);
  const of = (...taken: string[]) =>
    nextColor(taken.map((color, n) => ({ ...THREE.vessels[n], color }) as never));
  expect([of(), of(...colors.slice(0, 1)), of(...colors)]).toEqual([colors[0], colors[1], colors[0]]);
  expect(colors).not.toContain(DOUBTFUL);
});

test('a document is never changed in place, and editing a missing vessel changes nothing', () => {
  const text = JSON.stringify(THREE);
  changed(THREE, 1, { name: 'x' });
  afterEdit(THREE, edited({ ...THREE, vessels: [] }, 1, 2, 3));
  expect(JSON.stringify(THREE)).toBe(text);
  expect(changed(THREE, 9, { name: 'x' })).toBe(THREE);
});

describe('the document after an edit', () => {
  test('that changed nothing is the same object', () => {
    expect(afterEdit(THREE, edited(THREE))).toBe(THREE);
  });

  test('keeps the objects of unchanged vessels and stoppers', () => {
    const moved = changed(THREE, 2, { line: 99 });
    const after = afterEdit(THREE, edited(moved));
    expect([after.vessels[0], after.vessels[2], after.stoppers]).toEqual([first, third, THREE.stoppers]);
    expect(after.vessels[0]).toBe(first);
    expect(after.vessels[2]).toBe(third);
    expect(after.stoppers).toBe(THREE.stoppers);
    expect(after.vessels[1]).toEqual({ ...second, line: 99 });
  });

  test('has no marks of vessels that lost them, and keeps all other marks', () => {
    const now = { ...THREE, rulers: [{ from: [0, 0, 0], to: [1, 0, 0] }] as const };
    const after = afterEdit(now, edited(changed(THREE, 2, { line: 99 }), 2));
    expect(after.marks).toEqual({ 1: NO_MARKS });
    expect(after.rulers).toBe(now.rulers);
  });
});

test('hidden and doubtful vessels are not shown', () => {
  const hidden = changed(changed(THREE, 2, { isHidden: true }), 3, { doubt: 'touches bone' });
  expect(shownVessels(hidden)).toEqual([first]);
  expect(doubtful(hidden).map((vessel) => vessel.id)).toEqual([3]);
});
