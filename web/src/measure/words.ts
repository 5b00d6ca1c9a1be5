/** Measured numbers as words. Where the file does not state its spacing, no length has a unit. */
import type { Stenosis } from '../core/messages';
import { hasMillimetres } from '../state/millimetres';
import type { Place } from './marks';
import type { SectionNumbers } from './sections';

export const NOTHING = '–';

const unit = (name: string): string => (hasMillimetres.value ? ` ${name}` : '');

/** Why lengths have no unit; nothing where they have one. */
export const unitless = (): string =>
  hasMillimetres.value ? '' : 'This scan has no voxel spacing: 1 mm is assumed, and lengths have no unit.';

/** A length, such as `3.02 mm`. */
export function mm(value: number | null, digits = 2): string {
  return value === null ? NOTHING : `${value.toFixed(digits)}${unit('mm')}`;
}

/** A diameter with its standard deviation, such as `3.02 ± 0.05 mm`. */
export function spread(diameter: number | null, uncertainty: number | null): string {
  if (diameter === null) {
    return NOTHING;
  }
  return uncertainty === null ? mm(diameter) : `${diameter.toFixed(2)} ± ${mm(uncertainty)}`;
}

export function area(value: number | null): string {
  return value === null ? NOTHING : `${value.toFixed(1)}${unit('mm²')}`;
}

/** What the engine says, without units where lengths have none. */
export function told(words: string): string {
  return hasMillimetres.value ? words : words.replaceAll(' mm²', '').replaceAll(' mm', '');
}

/** A graded stenosis in one line. */
export const stenosisWords = (stenosis: Stenosis): string => told(stenosis.words);

/** Why a marked place has no percentage; the engine has not answered yet where it does not say. */
export const notGradedWords = ({ notGraded }: { readonly notGraded: string | null }): string =>
  notGraded === null ? 'Grading…' : `No percentage: ${told(notGraded)}`;

/** How a place is called. */
export function placeName({ kind, slot, isSuggestion, isBefore }: Place): string {
  const end = slot === 0 ? 'start' : 'end';
  const names = {
    place: isSuggestion ? 'narrowest place' : 'marked place',
    reference: (isBefore ?? slot === 0) ? 'reference before' : 'reference after',
    stretch: `${end} of the stretch`,
    secondStretch: `${end} of the second stretch`,
    diameter: 'noted diameter',
  };
  return `${names[kind]}${isSuggestion ? ' (suggestion)' : ''}`;
}

/** The flags of a section, and what calcium or metal beside it leaves open. */
export const doubtWords = ({ flags, bounds }: SectionNumbers): readonly string[] =>
  bounds === null ? flags : [...flags, told(bounds)];

/** A section in one line. */
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

/** An angle (radians) in whole degrees. */
export const degrees = (radians: number): string => `${Math.round((radians * 180) / Math.PI)}°`;
