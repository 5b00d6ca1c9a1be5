/** What a click does now: it looks, sets a point of a vessel, a stopper, where a tree begins, a ruler, or the places of a measurement. */
import { signal } from '@preact/signals';

export type Tool = 'look' | 'trace' | 'stopper' | 'seed' | 'ruler';

export const tool = signal<Tool>('look');

/** The vessel of the document whose points are set now, by its id; null where the next point begins one. */
export const active = signal<number | null>(null);
