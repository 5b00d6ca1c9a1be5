/** Edits of a vessel as a whole: name, colour, visibility, cutting and joining. */
import type { Asked } from '../core/asked';
import type { DocumentVessel } from '../core/messages';
import { changed, vesselOf } from '../state/changes';
import { commit, commitPlain, isDone } from './committing';

export const rename = (id: number, name: string): Promise<boolean> => set('rename a vessel', id, { name });

export const recolor = (id: number, color: string): Promise<boolean> => set('colour a vessel', id, { color });

export const hide = (id: number, isHidden: boolean): Promise<boolean> =>
  set(isHidden ? 'hide a vessel' : 'show a vessel', id, { isHidden });

/** Changes fields of a vessel at once, even while the engine is busy. An unchanged value creates no undo step. */
function set(words: string, id: number, to: Partial<DocumentVessel>): Promise<boolean> {
  return commitPlain(words, (document) => {
    const vessel = vesselOf(document, id);
    const isSame = vessel && Object.entries(to).every(([key, value]) => vessel[key as 'name'] === value);
    return isSame ? document : changed(document, id, to);
  });
}

export const remove = (engine: Asked, ids: readonly number[]): Promise<boolean> =>
  isDone(commit(engine, { kind: 'remove', ids }));

export const cut = (engine: Asked, id: number, at: number): Promise<boolean> =>
  isDone(commit(engine, { kind: 'cut', id, at }));

export const join = (engine: Asked, id: number, other: number): Promise<boolean> =>
  isDone(commit(engine, { kind: 'join', id, other }));
