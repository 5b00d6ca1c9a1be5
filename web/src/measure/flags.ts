/** What there is to know of sections, in words; the order, words and colours are those of Python's plots. */

import type { Profile, Spot } from '../core/measuring';
import type { Pair } from '../core/messages';
import { nearestSection } from './sections';

interface FlagLook {
  readonly word: string;
  /** What it means. */
  readonly meaning: string;
  /** On paper, and on the dark ground of the page. */
  readonly paper: string;
  readonly screen: string;
}

export const FLAGS: readonly FlagLook[] = [
  {
    word: 'at limit',
    meaning: 'the diameter is below 1.5 FWHM, so that little is left of it in the picture',
    paper: '#7b5ea7',
    screen: '#b59ae0',
  },
  {
    word: 'branch',
    meaning: 'the section lies in a junction, or lumen goes on sideways',
    paper: '#3a7d44',
    screen: '#63b972',
  },
  {
    word: 'calcium',
    meaning: 'something in the wall is brighter than lumen; it is not lumen',
    paper: '#b8860b',
    screen: '#e0ac2b',
  },
  {
    word: 'metal',
    meaning: 'something brighter goes all around, or is far brighter, such as a stent',
    paper: '#4d4d4d',
    screen: '#b4b4b4',
  },
  {
    word: 'neighbor',
    meaning: 'another vessel, or bone, is beside the wall',
    paper: '#20808d',
    screen: '#45b9c8',
  },
  { word: 'outside', meaning: 'the section reaches beyond the volume', paper: '#8c564b', screen: '#c99184' },
  {
    word: 'no edge',
    meaning: 'no wall was found, or none that can be believed',
    paper: '#d62728',
    screen: '#ff6f6f',
  },
  {
    word: 'recentered',
    meaning: 'the centerline lies outside of the lumen that was measured',
    paper: '#e377c2',
    screen: '#f09fd6',
  },
  {
    word: 'irregular',
    meaning: 'the wall is far from an ellipse, so that shortest and longest diameter say little',
    paper: '#6b8e23',
    screen: '#a4c957',
  },
];

/** Flags with what they mean, a line for each. */
export const meanings = (words: readonly string[]): string =>
  FLAGS.filter(({ word }) => words.includes(word))
    .map(({ word, meaning }) => `${word}: ${meaning}`)
    .join('\n');

/** The flags that are set somewhere, in their order. */
export function flagsIn(profile: Profile): readonly FlagLook[] {
  const found = new Set(profile.flags.flat());
  return FLAGS.filter(({ word }) => found.has(word));
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
  const words = FLAGS.flatMap(({ word }) => (found.has(word) ? [word] : []));
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
