/** The active tool, which determines what a click does. */
import { signal } from '@preact/signals';

export type Tool = 'look' | 'trace' | 'stopper' | 'seed' | 'ruler';

export const tool = signal<Tool>('look');

/** Id of the vessel being extended; null if the next point begins one. */
export const active = signal<number | null>(null);
