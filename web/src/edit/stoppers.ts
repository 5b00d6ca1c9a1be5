/** Stoppers: spheres that no vessel may pass. */
import type { AfterEdit, Vector } from '../core/messages';
import { commit, isDone } from './committing';

export const STOPPER = 'Sphere that no centerline may pass; place it where a centerline leaves its vessel';

export const addStopper = (center: Vector): Promise<AfterEdit | null> =>
  commit({ kind: 'add_stopper', center });

export const moveStopper = (number: number, center: Vector): Promise<boolean> =>
  isDone(commit({ kind: 'move_stopper', number, center }));

export const removeStopper = (number: number): Promise<boolean> =>
  isDone(commit({ kind: 'remove_stopper', number }));
