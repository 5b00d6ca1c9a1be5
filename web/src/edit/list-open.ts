/** Whether the list of vessels is shown. */
import { signal } from '@preact/signals';

export const isListOpen = signal(false);

/** Below this window width the list would cover the views (CSS pixels). */
const NARROW = 760;

export function openList(): void {
  isListOpen.value ||= window.innerWidth > NARROW;
}
