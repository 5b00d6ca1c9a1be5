/** Names of the files that are saved: scan, content, side of the view and time, so that one is told from another. */
import type { Vector } from '../core/messages';

/** What a name tells, in this order. */
export interface Named {
  /** As the study is called; null where the file must not tell it. */
  readonly scan: string | null;
  readonly content: string;
  /** The side of a view. */
  readonly side?: string | null;
  /** Without its dot. */
  readonly ending: string;
}

/** No name is longer than this before its content, because systems of files refuse long ones. */
const LONGEST_SCAN = 60;
const ENDINGS = /\.(nii|nrrd|nhdr|mha|mhd|dcm|zip|gz|npz|raw)$/i;

/** `thorax-picture-anterior-2026-11-25-0915.png`. */
export function fileName({ scan, content, side = null, ending }: Named, now = new Date()): string {
  const parts = [plainScan(scan ?? '') || 'lumencut', content, side, timeWords(now)];
  return `${parts.filter((part) => part !== null && part !== '').join('-')}.${ending}`;
}

/** A name without the endings of its format, and without what systems of files refuse. */
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

/** Each axis (LPS): the side towards its low end, then towards its high end. */
const SIDES = [
  ['right', 'left'],
  ['anterior', 'posterior'],
  ['inferior', 'superior'],
] as const;
/** A side is named where the view is turned to it by more than half of the 45 degrees between two sides. */
const NAMED_FROM = Math.sin(Math.PI / 8);

/** From which sides a view looks at the patient, the most facing one first: `anterior`, `anterior-left`. */
export function sideOf(direction: Vector): string {
  const length = Math.hypot(...direction);
  return direction
    .map((along, axis) => ({ share: Math.abs(along) / length, side: SIDES[axis]?.[along < 0 ? 1 : 0] ?? '' }))
    .filter(({ share }) => share > NAMED_FROM)
    .sort((a, b) => b.share - a.share)
    .map(({ side }) => side)
    .join('-');
}
