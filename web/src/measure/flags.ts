/** Flags of sections. Order, words, meanings and colours come from the engine. */

import type { Profile } from '../core/messages';

export const meanings = ({ flag_table }: Profile, words: readonly string[]): string =>
  flag_table
    .filter(({ word }) => words.includes(word))
    .map(({ word, meaning }) => `${word}: ${meaning}`)
    .join('\n');
