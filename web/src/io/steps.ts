/** Long work in steps: between them the worker hears a stop, and the page how far the work is. */
import { Failure } from '../core/failure';
import type { Progress } from '../core/messages';

export type Told = (progress: Progress) => void;

/** How long the worker computes before it listens (ms). */
const LISTENING = 30;

export class Steps {
  private heard = performance.now();

  constructor(
    private readonly told: Told,
    readonly signal: AbortSignal,
  ) {}

  /** Tells how far the work is, where that was some time ago, and throws where it is to stop. */
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
