/** Balls that no vessel may pass. */
import type { Vector } from '../core/messages';
import type { Tracing } from '../core/tracing';
import { withStopper } from './changes';
import { commit } from './committing';

/** What a stopper is for. */
export const STOPPER = 'A ball that no vessel may pass: set it where the line takes a wrong way';

/** The radius of a stopper (mm), as in Python. */
export const STOPPER_RADIUS = 3;

export function addStopper(tracing: Tracing, center: Vector): Promise<boolean> {
  const stopper = { center, radius: STOPPER_RADIUS };
  return commit(tracing, 'add a stopper', (document) =>
    withStopper(document, document.stoppers.length, stopper),
  );
}

export function moveStopper(tracing: Tracing, number: number, center: Vector): Promise<boolean> {
  return commit(tracing, 'move a stopper', (document) => {
    const stopper = document.stoppers[number];
    return stopper ? withStopper(document, number, { ...stopper, center }) : document;
  });
}

export function removeStopper(tracing: Tracing, number: number): Promise<boolean> {
  return commit(tracing, 'remove a stopper', (document) => withStopper(document, number, null));
}
