/** Flags of doubtful sections. The engine defines their order, words, meanings and colours. */

import type { Profile } from '../core/messages';

export const meanings = ({ flag_table }: Profile, words: readonly string[]): string =>
  flag_table
    .filter(({ word }) => words.includes(word))
    .map(({ word, meaning }) => `${word}: ${meaning}`)
    .join('\n');
