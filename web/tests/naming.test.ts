import { expect, test } from 'vitest';
import { type About, Failure } from '../src/core/failure';
import type { Vector } from '../src/core/messages';
import { isClicked, withVessel } from '../src/edit/changes';
import { EMPTY } from '../src/edit/document';
import { inNames } from '../src/edit/naming';

const A: Vector = [0, 0, 0];
const B: Vector = [10, 0, 0];
const C: Vector = [20, 0, 0];

const before = withVessel(EMPTY, { line: 1, name: 'SMA', clicks: [A, B] });
const after = withVessel(before, { line: -1, name: '', id: 7, clicks: [C, A] });
const told = (about?: About) => {
  const mends = [{ name: 'bridge', values: [] }] as const;
  const more = { mends, place: B, value: 3, ...(about && { about }) };
  const failure = new Failure('tracing', 'points in a text', 'x', 'y', 'z', more);
  return inNames(failure, after.vessels.filter(isClicked), before);
};

test.each([
  [{ vessel: 1, point: 0 }, 'this point'],
  [{ vessel: 0, point: 1 }, 'point 2 of SMA'],
  [{ vessel: 1, point: null }, 'points of vessel 7'],
  [{ vessel: null, point: null }, 'this point'],
  [undefined, 'points in a text'],
])('%o is told as %s', (about, words) => {
  expect(told(about).subject).toBe(words);
});

test('all else of the failure stays', () => {
  expect(told({ vessel: 0, point: 0 })).toMatchObject({
    kind: 'tracing',
    found: 'x',
    expected: 'y',
    advice: 'z',
    mends: [{ name: 'bridge', values: [] }],
    place: B,
    value: 3,
  });
});
