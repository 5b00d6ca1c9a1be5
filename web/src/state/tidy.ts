/** How a tree is being cleaned: the limits below which vessels are marked, and the vessel that a row points at. */
import { signal } from '@preact/signals';

/** Vessels shorter and thinner than these (mm) are marked; 0 marks none. */
export const shorterThan = signal(0);
export const thinnerThan = signal(0);

/** Whether the reader wants the list to show the vessels as a tree; null as long as that was not chosen. */
export const treeChosen = signal<boolean | null>(null);

/** The vessel of the document whose row the pointer is over. */
export const lit = signal<number | null>(null);

/** No vessel is marked any more. */
export function markNone(): void {
  shorterThan.value = 0;
  thinnerThan.value = 0;
}
