import { describe, expect, test } from 'vitest';
import {
  changed,
  documentOf,
  doubtful,
  freshId,
  freshName,
  nameOf,
  replaced,
  shownVessels,
  without,
  withVessel,
  withVessels,
} from '../src/edit/changes';
import { type Document, NO_MARKS } from '../src/edit/document';
import { DOUBTFUL, nextColor, PALETTE } from '../src/edit/palette';
import { reportOf } from './fake-tracing';

const documentWith = (...names: string[]): Document =>
  documentOf(reportOf(names.map((name, n) => ({ line: 10 + n, name }))).vessels ?? []);

const ids = (document: Document) => document.vessels.map((vessel) => vessel.id);

describe('ids', () => {
  test('a study counts its vessels from 1, and one without a name is called so', () => {
    const document = documentWith('', 'aorta');
    expect(ids(document)).toEqual([1, 2]);
    expect(document.vessels.map(nameOf)).toEqual(['vessel 1', 'aorta']);
  });

  test('are never given twice, also not after the last vessel is gone', () => {
    const document = documentWith('a', 'b');
    const [rest, next] = [without(document, [2]), freshId(document)];
    expect(next).toBe(3);
    expect(freshId(rest)).toBe(4);
  });

  test('are larger than those of a document that was read', () => {
    const [vessel] = documentWith('a').vessels;
    const read = { ...documentWith(), vessels: vessel ? [{ ...vessel, id: 70 }] : [] };
    expect(freshId(read)).toBe(71);
  });
});

describe('colours', () => {
  test('differ as long as there are some, and then the first comes again', () => {
    const document = documentWith(...PALETTE.map(() => ''), '');
    const colors = document.vessels.map((vessel) => vessel.color);
    expect(new Set(colors.slice(0, PALETTE.length)).size).toBe(PALETTE.length);
    expect(colors.at(-1)).toBe(colors[0]);
    expect(colors).not.toContain(DOUBTFUL);
  });

  test('of a vessel that was deleted are free again', () => {
    const document = documentWith('a', 'b', 'c');
    expect(nextColor(without(document, [2]).vessels)).toBe(document.vessels[1]?.color);
  });
});

test('a document is never changed in place', () => {
  const document = documentWith('a', 'b');
  const text = JSON.stringify(document);
  changed(document, 1, { name: 'x' });
  without(document, [1]);
  replaced(document, 1, [{ line: 3 }]);
  withVessel(document, { line: 3 });
  expect(JSON.stringify(document)).toBe(text);
});

test('what is not there is not changed', () => {
  const document = documentWith('a');
  expect(changed(document, 9, { name: 'x' })).toBe(document);
});

test('a vessel goes with its marks, and parts take its place in the list without them', () => {
  const document = { ...documentWith('a', 'b', 'c'), marks: { 1: NO_MARKS, 2: NO_MARKS } };
  expect(without(document, [2]).marks).toEqual({ 1: NO_MARKS });
  const after = replaced(document, 2, [
    { id: 2, line: 20, name: 'b' },
    { line: 21, name: 'b part 1' },
  ]);
  expect(after.vessels.map(nameOf)).toEqual(['a', 'b', 'b part 1', 'c']);
  expect(ids(after)).toEqual([1, 2, 4, 3]);
  expect(after.marks).toEqual({ 1: NO_MARKS });
});

test('hidden and doubtful vessels are not shown', () => {
  const document = withVessels(documentWith('a'), [
    { line: 1, name: 'hidden', isHidden: true },
    { line: 2, name: 'doubtful', doubt: 'touches bone' },
  ]);
  expect(shownVessels(document).map(nameOf)).toEqual(['a']);
  expect(doubtful(document).map(nameOf)).toEqual(['doubtful']);
});

test('new names are those that no vessel has', () => {
  expect(freshName(documentWith('Vessel 1', 'Vessel 3'), 'Vessel')).toBe('Vessel 2');
});
