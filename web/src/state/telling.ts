/** Short messages that go by themselves. */
import { signal } from '@preact/signals';
import { Failure } from '../core/failure';
import { problem, report } from './store';

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

/** Shows why something was not done; nothing where it was interrupted, or asked of a study that is closed meanwhile. */
export function tellFailure(error: unknown): void {
  const failure = Failure.of(error);
  if (failure.kind !== 'interrupted' && report.value) {
    problem.value = failure;
  }
}
