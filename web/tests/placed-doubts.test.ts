import { expect, test } from 'vitest';
import type { DocumentVessel, VesselDoubt } from '../src/core/messages';
import { placedDoubts } from '../src/state/placed-doubts';
import { tree } from '../src/state/shown';
import { addDoubts, vesselDoubts } from '../src/state/store';
import { passesNear } from '../src/views/curves';

const doubt = (line: number, kind: string, at: number): VesselDoubt => ({
  line,
  kind,
  at,
  words: `at ${at}`,
});
const shown = (...lines: number[]) => lines.map((line) => ({ id: line, line }) as DocumentVessel);

test('alike doubts of shown vessels stand together, the most frequent first', () => {
  vesselDoubts.value = [];
  tree.value = shown(7, 9);
  addDoubts([doubt(9, 'turns too tightly', 4), doubt(7, 'crosses a wall', 1)]);
  addDoubts([doubt(9, 'crosses a wall', 2), doubt(8, 'crosses a wall', 3)]);
  const found = placedDoubts.value.map(([kind, all]) => [
    kind,
    all.map(({ vessel, at }) => [vessel.id - 7, at]),
  ]);
  expect(found).toEqual([
    [
      'crosses a wall',
      [
        [0, 1],
        [2, 2],
      ],
    ],
    ['turns too tightly', [[2, 4]]],
  ]);
  // Undo returns the line of the third vessel; another line in its place has no doubts.
  tree.value = shown(8);
  expect(placedDoubts.value.map(([, all]) => all.length)).toEqual([1]);
  tree.value = shown(10);
  expect(placedDoubts.value).toEqual([]);
});

test('a line passes near a place if one of its points does', () => {
  const line = [
    [0, 0, 0],
    [0, 0, 30],
  ] as const;
  expect([29, 31].map((x) => passesNear(line, [x, 0, 30], 30))).toEqual([true, false]);
});
