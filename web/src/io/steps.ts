/** Splits long work into steps. Between steps the worker reports progress and can receive a stop request. */
import { Failure } from '../core/failure';
import type { Progress } from '../core/messages';

export type OnProgress = (progress: Progress) => void;

const LISTEN_AFTER_MS = 30;

export class Steps {
  private lastReport = performance.now();

  constructor(
    private readonly onProgress: OnProgress,
    readonly signal: AbortSignal,
  ) {}

  /** Reports progress at intervals; throws if the user has stopped the work. */
  async step(words: string, done: number, total: number | null): Promise<void> {
    if (performance.now() - this.lastReport >= LISTEN_AFTER_MS) {
      this.onProgress({ words, done, total });
      await new Promise((listened) => setTimeout(listened, 0));
      this.lastReport = performance.now();
    }
    if (this.signal.aborted) {
      throw new Failure('interrupted', 'opening', 'a stop', 'the end of the file');
    }
  }
}
