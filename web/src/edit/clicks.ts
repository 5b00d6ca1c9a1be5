/** The clicks of vessels. After each edit the vessels that were clicked are traced anew; a click that is refused changes nothing. */
import type { Asked } from '../core/asked';
import type { AfterEdit, Vector } from '../core/messages';
import { commit, isDone } from './committing';

/**
 * Begins a vessel with two clicks or more; gives what came of it, or null where it was refused. `begun` hears its id also where the
 * user bridges a gap after that.
 */
export function beginVessel(
  engine: Asked,
  clicks: readonly Vector[],
  begun: (id: number) => void = () => undefined,
): Promise<AfterEdit | null> {
  const then = ({ added: [id] }: { readonly added: readonly number[] }) =>
    id === undefined ? null : begun(id);
  return commit(engine, { kind: 'begin_vessel', clicks }, { then });
}

/** The vessel that was begun. */
export const begunId = (answer: AfterEdit | null): number | null => answer?.edited.added[0] ?? null;

/** Adds a click at the end of a vessel; gives what came of it, or null where it was refused. */
export const addClick = (engine: Asked, id: number, point: Vector): Promise<AfterEdit | null> =>
  commit(engine, { kind: 'add_click', id, point });

/** Adds a click where the line of a vessel was taken hold of. */
export const addClickOnLine = (engine: Asked, id: number, point: Vector): Promise<boolean> =>
  isDone(commit(engine, { kind: 'add_click_on_line', id, point }));

export const moveClick = (engine: Asked, id: number, number: number, point: Vector): Promise<boolean> =>
  isDone(commit(engine, { kind: 'move_click', id, number, point }));

/** Removes a click; a vessel that would have only one left goes with it. */
export const removeClick = (engine: Asked, id: number, number: number): Promise<boolean> =>
  isDone(commit(engine, { kind: 'remove_click', id, number }));

/** Whether vessels go on where no lumen is seen. */
export const setBridge = (engine: Asked, bridge: boolean): Promise<boolean> =>
  isDone(commit(engine, { kind: 'set_bridge', bridge }));
