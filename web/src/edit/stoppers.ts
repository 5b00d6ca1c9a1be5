/** Balls that no vessel may pass. */
import type { Asked } from '../core/asked';
import type { AfterEdit, Vector } from '../core/messages';
import { commit, isDone } from './committing';

/** What a stopper is for. */
export const STOPPER = 'A ball that no vessel may pass: set it where the line takes a wrong way';

export const addStopper = (engine: Asked, center: Vector): Promise<AfterEdit | null> =>
  commit(engine, { kind: 'add_stopper', center });

export const moveStopper = (engine: Asked, number: number, center: Vector): Promise<boolean> =>
  isDone(commit(engine, { kind: 'move_stopper', number, center }));

export const removeStopper = (engine: Asked, number: number): Promise<boolean> =>
  isDone(commit(engine, { kind: 'remove_stopper', number }));
