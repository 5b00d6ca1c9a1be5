/** Edits of a vessel as a whole: name, colour, visibility, cutting and joining. */
import { VESSEL_NAMES } from '../core/generated/tables';
import type { DocumentVessel } from '../core/messages';
import { changed, vesselOf } from '../state/changes';
import { marked, markNone, unconnected } from '../state/tidying';
import { commit, commitPlain, isDone } from './committing';

export const rename = (id: number, name: string): Promise<boolean> => set('rename a vessel', id, { name });

export const recolor = (id: number, color: string): Promise<boolean> => set('colour a vessel', id, { color });

export const hide = (id: number, isHidden: boolean): Promise<boolean> =>
  set(isHidden ? 'hide a vessel' : 'show a vessel', id, { isHidden });

export function hideAll(vessels: readonly DocumentVessel[], isHidden: boolean): Promise<boolean> {
  const words = isHidden ? 'hide veins and heart' : 'show veins and heart';
  return commitPlain(words, (document) =>
    vessels.reduce((before, { id }) => changed(before, id, { isHidden }), document),
  );
}

/** Changes fields of a vessel at once, even while the engine is busy. An unchanged value creates no undo step. */
function set(words: string, id: number, to: Partial<DocumentVessel>): Promise<boolean> {
  return commitPlain(words, (document) => {
    const vessel = vesselOf(document, id);
    const isSame = vessel && Object.entries(to).every(([key, value]) => vessel[key as 'name'] === value);
    return isSame ? document : changed(document, id, to);
  });
}

export const hideBone = (hidden: boolean): Promise<boolean> => isDone(commit({ kind: 'hide_bone', hidden }));

type Contour = DocumentVessel['contours'][number];

/** Draws a contour by hand, in place of an earlier one on its section, whose arc length is its first number. */
export const drawContour = (id: number, contour: Contour): Promise<boolean> =>
  setContours('draw a contour', id, contour[0] ?? 0, [contour]);

export const removeContour = (id: number, at: number): Promise<boolean> =>
  setContours('return to the automatic contour', id, at, []);

function setContours(words: string, id: number, at: number, to: readonly Contour[]): Promise<boolean> {
  return commitPlain(words, (document) => {
    const others = vesselOf(document, id)?.contours.filter(([place]) => place !== at) ?? [];
    return changed(document, id, { contours: [...others, ...to] });
  });
}

export const remove = (ids: readonly number[]): Promise<boolean> => isDone(commit({ kind: 'remove', ids }));

export const cut = (id: number, at: number): Promise<boolean> => isDone(commit({ kind: 'cut', id, at }));

export const join = (id: number, other: number): Promise<boolean> =>
  isDone(commit({ kind: 'join', id, other }));

export async function removeMarked(): Promise<boolean> {
  const isRemoved = await remove([...marked.value]);
  if (isRemoved) {
    markNone();
  }
  return isRemoved;
}

export const keepPart = (): Promise<boolean> => remove(unconnected.value);

/** Anatomical names offered when the user names a vessel. */
export function namesToOffer(taken: readonly string[]): string[] {
  const used = new Set(taken.map((name) => name.trim().toLowerCase()));
  return VESSEL_NAMES.filter((name) => !used.has(name.toLowerCase())).sort((a, b) =>
    a.localeCompare(b, 'en'),
  );
}
