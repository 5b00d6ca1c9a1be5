/** Formats measurements as text, without units if the voxel spacing is unknown. */
import type { Profile, Stenosis } from '../core/messages';
import { hasMillimetres } from '../state/millimetres';
import type { VesselPlace } from './marks';
import type { SectionNumbers } from './sections';

export const NOTHING = '–';

const unit = (name: string): string => (hasMillimetres.value ? ` ${name}` : '');

/** A sentence that explains why lengths have no unit; empty if they have one. */
export const unitless = (): string =>
  hasMillimetres.value ? '' : 'This scan has no voxel spacing: 1 mm is assumed, and lengths have no unit.';

/** A length as text, such as `3.02 mm`. */
export function mm(value: number | null, digits = 2): string {
  return value === null ? NOTHING : `${value.toFixed(digits)}${unit('mm')}`;
}

export function spread(diameter: number | null, uncertainty: number | null): string {
  if (diameter === null) {
    return NOTHING;
  }
  return uncertainty === null ? mm(diameter) : `${diameter.toFixed(2)} ± ${mm(uncertainty)}`;
}

export function area(value: number | null): string {
  return value === null ? NOTHING : `${value.toFixed(1)}${unit('mm²')}`;
}

/** A text of the engine, without " mm" and " mm²" if the length unit of the scan is unknown. */
export function withKnownUnits(words: string): string {
  return hasMillimetres.value ? words : words.replaceAll(' mm²', '').replaceAll(' mm', '');
}

export const stenosisWords = (stenosis: Stenosis): string => withKnownUnits(stenosis.words);

/** Text shown in place of a missing percentage: the diameter and the reason; null until the engine has answered. */
export const notGradedWords = ({ notGraded }: { readonly notGraded: string | null }): string =>
  notGraded === null ? 'Grading…' : withKnownUnits(notGraded);

export function placeName({ kind, slot, isSuggestion, isConfirmed, isBefore }: VesselPlace): string {
  const end = slot === 0 ? 'start' : 'end';
  const names = {
    place: isSuggestion || isConfirmed ? 'narrowest place' : 'marked place',
    reference: (isBefore ?? slot === 0) ? 'reference before' : 'reference after',
    stretch: `${end} of the stretch`,
    secondStretch: `${end} of the second stretch`,
    diameter: 'noted diameter',
  };
  const origin = isSuggestion ? ' (suggestion)' : isConfirmed ? ' (confirmed suggestion)' : '';
  return `${names[kind]}${origin}`;
}

/** Words for the doubts about a section: its flags, and the uncertainty due to calcium or metal. */
export const doubtWords = ({ flags, bounds }: SectionNumbers): readonly string[] =>
  bounds === null ? flags : [...flags, withKnownUnits(bounds)];

export function sectionWords(section: SectionNumbers): string {
  const { at, diameter, uncertainty, shortest, longest, counts } = section;
  const parts = [`${mm(at, 1)}:`];
  if (diameter === null) {
    parts.push('not measured');
  } else {
    parts.push(`diameter ${spread(diameter, uncertainty)},`);
    parts.push(`${shortest?.toFixed(2) ?? NOTHING} to ${mm(longest)},`);
    parts.push(`area ${area(section.area)}`);
  }
  const words = [...(counts ? [] : ['left out']), ...doubtWords(section)].join(', ');
  return `${parts.join(' ')}${words ? ` · ${words}` : ''}`;
}

export const degrees = (radians: number): string => `${Math.round((radians * 180) / Math.PI)}°`;

export const meanings = ({ flag_table }: Profile, words: readonly string[]): string =>
  flag_table
    .filter(({ word }) => words.includes(word))
    .map(({ word, meaning }) => `${word}: ${meaning}`)
    .join('\n');
