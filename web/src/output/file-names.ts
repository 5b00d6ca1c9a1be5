/** Names of saved files, made of scan name, content, viewing side and time. */

import type { Vector } from '../core/messages';
import { studyName } from '../state/store';

export interface Named {
  /** Name of the scan; null if the file name must not identify it. */
  readonly scan: string | null;
  readonly content: string;
  readonly side?: string | null;
  readonly ending: string;
}

/** Longer scan names are shortened, because file systems limit the length of file names. */
const LONGEST_SCAN = 60;
const ENDINGS = /\.(nii|nrrd|nhdr|mha|mhd|dcm|zip|gz|npz|raw)$/i;

/** A file name such as `thorax-picture-anterior-2026-11-25-0915.png`. */
export function fileName({ scan, content, side = null, ending }: Named, now = new Date()): string {
  const parts = [plainScan(scan ?? '') || 'lumencut', content, side, timeWords(now)];
  return `${parts.filter((part) => part !== null && part !== '').join('-')}.${ending}`;
}

/** The scan name without format extensions, and without characters that file systems reject. */
function plainScan(name: string): string {
  const bare = name.replace(ENDINGS, '').replace(ENDINGS, '');
  const plain = bare.replace(/[^\p{L}\p{N}_]+/gu, '-').replace(/^-+|-+$/g, '');
  return [...plain].slice(0, LONGEST_SCAN).join('');
}

function timeWords(now: Date): string {
  const two = (number: number) => String(number).padStart(2, '0');
  const day = `${now.getFullYear()}-${two(now.getMonth() + 1)}-${two(now.getDate())}`;
  return `${day}-${two(now.getHours())}${two(now.getMinutes())}`;
}

/** For each LPS axis, the sides of the patient at its low and its high end. */
const SIDES = [
  ['right', 'left'],
  ['anterior', 'posterior'],
  ['inferior', 'superior'],
] as const;
/** Smallest component of the view direction for a side to be named; the view then faces it within 67.5°. */
const NAMED_FROM = Math.sin(Math.PI / 8);

/** The sides from which the patient is seen, the main one first, such as `anterior-left`. */
export function sideOf(direction: Vector): string {
  const length = Math.hypot(...direction);
  return direction
    .map((along, axis) => ({ share: Math.abs(along) / length, side: SIDES[axis]?.[along < 0 ? 1 : 0] ?? '' }))
    .filter(({ share }) => share > NAMED_FROM)
    .sort((a, b) => b.share - a.share)
    .map(({ side }) => side)
    .join('-');
}

export const studyFileName = (named: Omit<Named, 'scan'>): string =>
  fileName({ ...named, scan: studyName.value });
