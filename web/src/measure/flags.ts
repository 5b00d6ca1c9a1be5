/** What there is to know of sections, in words. The engine's table has their order, words, meanings and colours. */

import type { FlagLook, Profile, Spot } from '../core/measuring';
import type { Pair } from '../core/messages';
import { nearestSection } from './sections';

/** Flags with what they mean, a line for each. */
export const meanings = ({ flag_table }: Profile, words: readonly string[]): string =>
  flag_table
    .filter(({ word }) => words.includes(word))
    .map(({ word, meaning }) => `${word}: ${meaning}`)
    .join('\n');

/** The flags that are set somewhere, in their order. */
export function flagsIn({ flags, flag_table }: Profile): readonly FlagLook[] {
  const found = new Set(flags.flat());
  return flag_table.filter(({ word }) => found.has(word));
}

/** A place on a vessel, and those that it is compared with (mm). */
export interface ComparedPlaces {
  readonly at: number;
  readonly references: readonly { readonly at: number }[];
}

/** What makes a percentage doubtful, a sentence each: flags of the places that it comes from, and a branch between them. */
export function doubtsOf(profile: Profile, { at, references }: ComparedPlaces): string[] {
  const place = nearestSection(profile, at);
  const others = references.map((reference) => nearestSection(profile, reference.at));
  const found = new Set([place, ...others].flatMap((n) => profile.flags[n] ?? []));
  const words = profile.flag_table.flatMap(({ word }) => (found.has(word) ? [word] : []));
  const between = (other: number) =>
    profile.flags.slice(Math.min(place, other) + 1, Math.max(place, other)).flat();
  const isBeyond = others.some((other) => between(other).includes('branch'));
  return [
    ...(words.length > 0 ? [`At these places: ${words.join(', ')}.`] : []),
    ...(isBeyond
      ? ['A branch lies between the place and a reference: beyond it a vessel may be of another width.']
      : []),
  ];
}

/** A section whose outline another vessel or an odd shape changes is no widest place, nor one beside it (mm). */
const ODD = ['irregular', 'branch'];
const BESIDE = 1;

/** The widest place, where it can be offered. */
export function offeredWidest({ widest, arc_length: places, flags }: Profile): Spot | null {
  const isOdd = places.some(
    (place, n) =>
      Math.abs(place - (widest?.at ?? 0)) <= BESIDE && flags[n]?.some((flag) => ODD.includes(flag)),
  );
  return isOdd ? null : widest;
}

/** Stretches with a flag: they begin half a step before their first section and end half a step behind the last (mm). */
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
