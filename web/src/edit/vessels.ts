/** Edits of a vessel as a whole: name, colour, visibility, cutting and joining. */
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

export const remove = (ids: readonly number[]): Promise<boolean> => isDone(commit({ kind: 'remove', ids }));

export const cut = (id: number, at: number): Promise<boolean> => isDone(commit({ kind: 'cut', id, at }));

export const join = (id: number, other: number): Promise<boolean> =>
  isDone(commit({ kind: 'join', id, other }));
