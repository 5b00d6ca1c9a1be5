import { signal } from '@preact/signals';
import { Failure } from '../core/failure';
import { problem, report } from './store';

const DISPLAY_MS = 8000;

export const message = signal<string | null>(null);
let timer = 0;

export function showMessage(words: string): void {
  window.clearTimeout(timer);
  message.value = words;
  timer = window.setTimeout(() => {
    message.value = null;
  }, DISPLAY_MS);
}

/** Shows a failure, unless the user stopped the work or closed the study meanwhile. */
export function showFailure(error: unknown): void {
  const failure = Failure.of(error);
  if (failure.kind !== 'interrupted' && report.value) {
    problem.value = failure;
  }
}
