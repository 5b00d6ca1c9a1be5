/** Places the names in a picture so that none covers another. */
import type { Pair } from '../core/messages';

export interface PlacedName {
  readonly words: string;
  /** Middle of the name (CSS pixels). */
  readonly at: Pair;
}

/** Estimated size of a letter of such a name (CSS pixels). */
export const LETTER: Pair = [7, 15];

/** The names in rising order; each is moved down until it covers no earlier one, nor `taken`. */
export function apart(
  names: readonly PlacedName[],
  taken: readonly PlacedName[] = [],
): readonly PlacedName[] {
  const placed: PlacedName[] = [];
  const ordered = [...names].sort((a, b) => a.at[1] - b.at[1] || a.at[0] - b.at[0]);
  for (const { words, at } of ordered) {
    let name: PlacedName = { words, at };
    for (let other = covered(name, taken, placed); other; other = covered(name, taken, placed)) {
      name = { words, at: [at[0], other.at[1] + LETTER[1]] };
    }
    placed.push(name);
  }
  return placed;
}

function covered(name: PlacedName, ...others: readonly (readonly PlacedName[])[]): PlacedName | undefined {
  const isOver = (other: PlacedName) =>
    Math.abs(name.at[0] - other.at[0]) < (LETTER[0] * (name.words.length + other.words.length)) / 2 &&
    Math.abs(name.at[1] - other.at[1]) < LETTER[1];
  return others.flat().find(isOver);
}
