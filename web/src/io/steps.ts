/** Splits long work into steps, so that the worker can receive a stop and report progress. */
import { Failure } from '../core/failure';
import type { Progress } from '../core/messages';

export type Told = (progress: Progress) => void;

/** Longest computation without checking for messages (ms). */
const LISTENING = 30;

export class Steps {
  private heard = performance.now();

  constructor(
    private readonly told: Told,
    readonly signal: AbortSignal,
  ) {}

  /** Reports progress at intervals; throws after a stop. */
  async step(words: string, done: number, total: number | null): Promise<void> {
    if (performance.now() - this.heard >= LISTENING) {
      this.told({ words, done, total });
      await new Promise((listened) => setTimeout(listened, 0));
      this.heard = performance.now();
    }
    if (this.signal.aborted) {
      throw new Failure('interrupted', 'opening', 'a stop', 'the end of the file');
    }
  }
}
