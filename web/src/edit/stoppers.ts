/** Stoppers: spheres that no vessel may pass. */
import type { Asked } from '../core/asked';
import type { AfterEdit, Vector } from '../core/messages';
import { commit, isDone } from './committing';

export const STOPPER = 'Sphere that no centerline may pass; place it where a centerline leaves its vessel';

export const addStopper = (engine: Asked, center: Vector): Promise<AfterEdit | null> =>
  commit(engine, { kind: 'add_stopper', center });

export const moveStopper = (engine: Asked, number: number, center: Vector): Promise<boolean> =>
  isDone(commit(engine, { kind: 'move_stopper', number, center }));

export const removeStopper = (engine: Asked, number: number): Promise<boolean> =>
  isDone(commit(engine, { kind: 'remove_stopper', number }));
