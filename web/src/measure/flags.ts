/** Flags of doubtful sections. The engine defines their order, words, meanings and colours. */

import type { FlagLook, Pair, Profile } from '../core/messages';

export const meanings = ({ flag_table }: Profile, words: readonly string[]): string =>
  flag_table
    .filter(({ word }) => words.includes(word))
    .map(({ word, meaning }) => `${word}: ${meaning}`)
    .join('\n');

export function flagsIn({ flags, flag_table }: Profile): readonly FlagLook[] {
  const found = new Set(flags.flat());
  return flag_table.filter(({ word }) => found.has(word));
}

/** Intervals of arc length with a flag (mm), extended by half a section distance at both ends. */
export function runs(profile: Profile, word: string): Pair[] {
  const { arc_length: places, flags } = profile;
  const half = ((places[1] ?? 1) - (places[0] ?? 0)) / 2;
  const found: [number, number][] = [];
  places.forEach((place, n) => {
    if (!flags[n]?.includes(word)) {
      return;
    }
    const last = found.at(-1);
    if (last && flags[n - 1]?.includes(word)) {
      last[1] = place + half;
    } else {
      found.push([place - half, place + half]);
    }
  });
  return found;
}
