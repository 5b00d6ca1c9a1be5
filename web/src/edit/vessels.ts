/** Vessels as wholes: their names, colours, whether they are shown, and cutting and joining them. */
import type { Asked } from '../core/asked';
import type { DocumentVessel } from '../core/messages';
import { changed, vesselOf } from '../state/changes';
import { commit, commitPlain, isDone } from './committing';

export const rename = (id: number, name: string): Promise<boolean> => set('rename a vessel', id, { name });

export const recolor = (id: number, color: string): Promise<boolean> => set('colour a vessel', id, { color });

export const hide = (id: number, isHidden: boolean): Promise<boolean> =>
  set(isHidden ? 'hide a vessel' : 'show a vessel', id, { isHidden });

/**
 * Sets a field of a vessel at once, also while the engine is measuring: nothing follows from it that the engine would decide. One
 * that leaves all as it is makes no step.
 */
function set(words: string, id: number, to: Partial<DocumentVessel>): Promise<boolean> {
  return commitPlain(words, (document) => {
    const vessel = vesselOf(document, id);
    const isSame = vessel && Object.entries(to).every(([key, value]) => vessel[key as 'name'] === value);
    return isSame ? document : changed(document, id, to);
  });
}

export const remove = (engine: Asked, ids: readonly number[]): Promise<boolean> =>
  isDone(commit(engine, { kind: 'remove', ids }));

/** Cuts a vessel in two at an arc length (mm). */
export const cut = (engine: Asked, id: number, at: number): Promise<boolean> =>
  isDone(commit(engine, { kind: 'cut', id, at }));

/** Joins a second vessel to a first one. */
export const join = (engine: Asked, id: number, other: number): Promise<boolean> =>
  isDone(commit(engine, { kind: 'join', id, other }));
