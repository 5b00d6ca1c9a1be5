import { expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Vector } from '../src/core/messages';
import { isClicked, withVessel } from '../src/edit/changes';
import { EMPTY } from '../src/edit/document';
import { inNames } from '../src/edit/naming';

const A: Vector = [0, 0, 0];
const B: Vector = [10, 0, 0];
const C: Vector = [20, 0, 0];

const before = withVessel(EMPTY, { line: 1, name: 'SMA', clicks: [A, B] });
const after = withVessel(before, { line: -1, name: '', id: 7, clicks: [C, A] });
const told = (subject: string) => {
  const failure = new Failure('tracing', subject, 'x', 'y', 'z', { place: B, value: 3 });
  return inNames(failure, after.vessels.filter(isClicked), before);
};

test.each([
  ['point 0 of vessel 1', 'this point'],
  ['point 1 of vessel 0', 'point 2 of SMA'],
  ['points of vessel 1', 'points of vessel 7'],
  ['point (1.0, -2.0, 3.0) mm', 'this point'],
  ['the way from a click', 'the way from a click'],
])('%s is told as %s', (subject, words) => {
  expect(told(subject).subject).toBe(words);
});

test('all else of the failure stays', () => {
  expect(told('point 0 of vessel 0')).toMatchObject({
    kind: 'tracing',
    found: 'x',
    expected: 'y',
    mend: 'z',
    place: B,
    value: 3,
  });
});
