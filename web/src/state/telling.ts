/** Temporary messages. */
import { signal } from '@preact/signals';
import { Failure } from '../core/failure';
import { problem, report } from './store';

const STAYS = 8000;

export const told = signal<string | null>(null);
let timer = 0;

export function tell(words: string): void {
  window.clearTimeout(timer);
  told.value = words;
  timer = window.setTimeout(() => {
    told.value = null;
  }, STAYS);
}

/** Reports a failure, except interruptions and errors of a study closed meanwhile. */
export function tellFailure(error: unknown): void {
  const failure = Failure.of(error);
  if (failure.kind !== 'interrupted' && report.value) {
    problem.value = failure;
  }
}
