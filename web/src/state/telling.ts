/** Short messages that go by themselves. */
import { signal } from '@preact/signals';

/** How long one stays (ms). */
const STAYS = 8000;

export const told = signal<string | null>(null);
let timer = 0;

/** Tells something for some seconds. */
export function tell(words: string): void {
  window.clearTimeout(timer);
  told.value = words;
  timer = window.setTimeout(() => {
    told.value = null;
  }, STAYS);
}
