/** The interface for requests to the engine, also implemented by test doubles. */
import type { Questions } from './generated/questions';
import type { GivenFile, Progress } from './messages';

export type Question = keyof Questions;
export type Message<N extends Question> = Questions[N]['message'];
export type Answer<N extends Question> = Questions[N]['answer'];

export type OnProgress = (progress: Progress) => void;

export interface Attachments {
  readonly onProgress?: OnProgress;
  readonly bytes?: Uint8Array;
  /** Files of a vessel mask; the worker reads them before it runs the edit. */
  readonly mask?: readonly GivenFile[];
}

export interface Asked {
  /** Answers a request listed in `generated/questions.ts`. Throws `Failure`. */
  ask<N extends Question>(name: N, message: Message<N>, attachments?: Attachments): Promise<Answer<N>>;
}
