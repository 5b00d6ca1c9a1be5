/** Runs a save and reports its failure. */
import { Failure } from '../core/failure';
import { problem } from '../state/store';

export function attempt(save: () => Promise<void>): void {
  save().catch((error: unknown) => {
    problem.value = Failure.of(error);
  });
}
