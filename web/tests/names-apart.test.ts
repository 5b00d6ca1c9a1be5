import { expect, test } from 'vitest';
import { apart, LETTER, type PlacedName } from '../src/views/names-apart';

const name = (words: string, x: number, y: number): PlacedName => ({ words, at: [x, y] });
const isOver = (a: PlacedName, b: PlacedName) =>
  Math.abs(a.at[0] - b.at[0]) < (LETTER[0] * (a.words.length + b.words.length)) / 2 &&
  Math.abs(a.at[1] - b.at[1]) < LETTER[1];

test('names that are far apart stay, and none covers another', () => {
  const far = [name('SMA', 20, 10), name('Vessel 2', 20, 60), name('Vessel 3', 200, 62)];
  expect(apart(far)).toEqual(far);
  const near = [name('Vessel 4', 40, 30), name('Vessel 2', 50, 31), name('Vessel 3', 45, 33)];
  const title = name('aorta', 40, 20);
  const placed = apart(near, [title]);
  expect(placed.map(({ words }) => words).sort()).toEqual(['Vessel 2', 'Vessel 3', 'Vessel 4']);
  for (const [n, one] of placed.entries()) {
    expect([title, ...placed.slice(n + 1)].filter((other) => isOver(one, other))).toEqual([]);
    expect(one.at[0]).toBe(near.find(({ words }) => words === one.words)?.at[0]);
  }
});
