/** Runs a function that saves something, and shows the error if it fails. */
import { Failure } from '../core/failure';
import { problem } from '../state/store';

export function attempt(save: () => Promise<void>): void {
  save().catch((error: unknown) => {
    problem.value = Failure.of(error);
  });
}
