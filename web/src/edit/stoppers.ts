/** Balls that no vessel may pass. */
import type { Vector } from '../core/messages';
import type { Tracing } from '../core/tracing';
import { commit, isDone } from './committing';

/** What a stopper is for. */
export const STOPPER = 'A ball that no vessel may pass: set it where the line takes a wrong way';

export const addStopper = (tracing: Tracing, center: Vector): Promise<boolean> =>
  isDone(commit(tracing, { kind: 'add_stopper', center }));

export const moveStopper = (tracing: Tracing, number: number, center: Vector): Promise<boolean> =>
  isDone(commit(tracing, { kind: 'move_stopper', number, center }));

export const removeStopper = (tracing: Tracing, number: number): Promise<boolean> =>
  isDone(commit(tracing, { kind: 'remove_stopper', number }));
