/** Whether the list of vessels is shown. */
import { signal } from '@preact/signals';

export const isListOpen = signal(false);

/** Below this window width the list would cover the views (CSS pixels). */
const NARROW = 760;

/** Opens the list if it fits next to the views. */
export function openList(): void {
  isListOpen.value ||= window.innerWidth > NARROW;
}
