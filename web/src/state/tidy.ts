/** State of "Clean up" and of the vessel list: limits that mark vessels, list order, and highlighted row. */
import { signal } from '@preact/signals';

/** Vessels below these limits (mm) are marked; 0 marks none. */
export const shorterThan = signal(0);
export const thinnerThan = signal(0);

/** Whether the user wants the list as a tree; null if the user has not chosen. */
export const treeChosen = signal<boolean | null>(null);

export const highlighted = signal<number | null>(null);

export function markNone(): void {
  shorterThan.value = 0;
  thinnerThan.value = 0;
}
