/** Whether the list of vessels is shown. */
import { signal } from '@preact/signals';

export const isListOpen = signal(false);

/** In narrower windows the list would cover the views (CSS pixels). */
const NARROW = 760;

/** Opens the list where there is room for it beside the views. */
export function openList(): void {
  isListOpen.value ||= window.innerWidth > NARROW;
}
