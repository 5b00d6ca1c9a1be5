/** What answers questions: the engine as the page has it, or a test in its place. */
import type { Questions } from './generated/questions';
import type { GivenFile, Progress } from './messages';

export type Question = keyof Questions;
export type Message<N extends Question> = Questions[N]['message'];
export type Answer<N extends Question> = Questions[N]['answer'];

export type Told = (progress: Progress) => void;

/** What a question can come with. */
export interface Beside {
  /** Hears how far long work is. */
  readonly told?: Told;
  /** The bytes of a file. */
  readonly bytes?: Uint8Array;
  /** The files of a mask that an edit adds: they are read first. */
  readonly mask?: readonly GivenFile[];
}

export interface Asked {
  /** The answer to a question of the table in `generated/questions.ts`. Throws `Failure`. */
  ask<N extends Question>(name: N, message: Message<N>, beside?: Beside): Promise<Answer<N>>;
}
