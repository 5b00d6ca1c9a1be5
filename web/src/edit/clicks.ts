/** Edits the clicked points of a vessel, and stoppers. Each edit retraces the vessel; a rejected click changes nothing. */
import type { AfterEdit, Vector } from '../core/messages';
import { commit, isDone } from './committing';

/** Begins a vessel with two or more clicks. `begun` receives its id, also if the user first bridges a gap. */
export function beginVessel(
  clicks: readonly Vector[],
  begun: (id: number) => void = () => undefined,
): Promise<AfterEdit | null> {
  const then = ({ added: [id] }: { readonly added: readonly number[] }) =>
    id === undefined ? null : begun(id);
  return commit({ kind: 'begin_vessel', clicks }, { then });
}

export const begunId = (answer: AfterEdit | null): number | null => answer?.edited.added[0] ?? null;

/** Extends a vessel to a clicked point. Returns null if the click was rejected. */
export const addClick = (id: number, point: Vector): Promise<AfterEdit | null> =>
  commit({ kind: 'add_click', id, point });

export const addClickOnLine = (id: number, point: Vector): Promise<boolean> =>
  isDone(commit({ kind: 'add_click_on_line', id, point }));

export const moveClick = (id: number, number: number, point: Vector): Promise<boolean> =>
  isDone(commit({ kind: 'move_click', id, number, point }));

/** Removes a clicked point; if only one point would remain, removes the whole vessel. */
export const removeClick = (id: number, number: number): Promise<boolean> =>
  isDone(commit({ kind: 'remove_click', id, number }));

export const setBridge = (bridge: boolean): Promise<boolean> =>
  isDone(commit({ kind: 'set_bridge', bridge }));

export const STOPPER = 'Sphere that no centerline may pass; place it where a centerline leaves its vessel';

export const addStopper = (center: Vector): Promise<AfterEdit | null> =>
  commit({ kind: 'add_stopper', center });

export const moveStopper = (number: number, center: Vector): Promise<boolean> =>
  isDone(commit({ kind: 'move_stopper', number, center }));

export const removeStopper = (number: number): Promise<boolean> =>
  isDone(commit({ kind: 'remove_stopper', number }));
