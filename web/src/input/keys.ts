/** Keys that act as drags, zooms and scrolls. */
import { GESTURES } from '../core/generated/tables';
import type { Pair } from '../core/messages';

const ARROWS: Readonly<Record<string, Pair>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** Direction of an arrow key (right, down). */
export const arrowOf = (key: string): Pair | null => ARROWS[key] ?? null;

/** The drag that an arrow key performs (pixels). */
export function dragOfKey(key: string): Pair | null {
  const arrow = arrowOf(key);
  return arrow && [arrow[0] * GESTURES.key_step, arrow[1] * GESTURES.key_step];
}

/** Zoom factor of the keys + and -. */
export function zoomOfKey(key: string): number | null {
  const { key_zoom: factor } = GESTURES;
  return { '+': factor, '-': 1 / factor }[key] ?? null;
}

/** Number of steps that an arrow or page key scrolls; a page key scrolls `page` steps. */
export function scrollOfKey(key: string, page: number = GESTURES.far_steps): number | null {
  return { ArrowDown: 1, PageDown: page, ArrowUp: -1, PageUp: -page }[key] ?? null;
}
