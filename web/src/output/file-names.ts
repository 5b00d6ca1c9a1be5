/** Names of saved files: scan, content, side of the view, and time. */
import type { Vector } from '../core/messages';

export interface Named {
  /** Null if the file must not identify the scan. */
  readonly scan: string | null;
  readonly content: string;
  readonly side?: string | null;
  readonly ending: string;
}

/** Longest scan name; file systems reject long names. */
const LONGEST_SCAN = 60;
const ENDINGS = /\.(nii|nrrd|nhdr|mha|mhd|dcm|zip|gz|npz|raw)$/i;

/** `thorax-picture-anterior-2026-11-25-0915.png`. */
export function fileName({ scan, content, side = null, ending }: Named, now = new Date()): string {
  const parts = [plainScan(scan ?? '') || 'lumencut', content, side, timeWords(now)];
  return `${parts.filter((part) => part !== null && part !== '').join('-')}.${ending}`;
}

/** Removes format extensions and characters that file systems reject. */
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

/** Per LPS axis: the side at its low end, then at its high end. */
const SIDES = [
  ['right', 'left'],
  ['anterior', 'posterior'],
  ['inferior', 'superior'],
] as const;
/** A side is named if the view faces it within 67.5°. */
const NAMED_FROM = Math.sin(Math.PI / 8);

/** Viewing sides, the most facing first: `anterior`, `anterior-left`. */
export function sideOf(direction: Vector): string {
  const length = Math.hypot(...direction);
  return direction
    .map((along, axis) => ({ share: Math.abs(along) / length, side: SIDES[axis]?.[along < 0 ? 1 : 0] ?? '' }))
    .filter(({ share }) => share > NAMED_FROM)
    .sort((a, b) => b.share - a.share)
    .map(({ side }) => side)
    .join('-');
}
