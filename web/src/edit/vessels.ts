/** Vessels as wholes: their names, colours, whether they are shown, and cutting and joining them. */
import type { LineId } from '../core/messages';
import type { Tracing } from '../core/tracing';
import { changed, freshName, nameOf, replaced, vesselOf, without } from './changes';
import { commitPlain, inTurn } from './committing';
import type { Document, DocumentVessel } from './document';

export const rename = (id: number, name: string): Promise<boolean> => set('rename a vessel', id, { name });

export const recolor = (id: number, color: string): Promise<boolean> => set('colour a vessel', id, { color });

export const hide = (id: number, isHidden: boolean): Promise<boolean> =>
  set(isHidden ? 'hide a vessel' : 'show a vessel', id, { isHidden });

/** An edit that leaves all as it is makes no step. */
function set(words: string, id: number, to: Partial<DocumentVessel>): Promise<boolean> {
  return commitPlain(words, (document) => {
    const vessel = vesselOf(document, id);
    const isSame = vessel && Object.entries(to).every(([key, value]) => vessel[key as 'name'] === value);
    return isSame ? document : changed(document, id, to);
  });
}

export const remove = (ids: readonly number[]): Promise<boolean> =>
  commitPlain(ids.length === 1 ? 'delete a vessel' : 'delete vessels', (document) => without(document, ids));

/** Cuts a vessel in two at an arc length (mm); the second part gets a name and a colour of its own. */
export function cut(tracing: Tracing, id: number, arcLength: number): Promise<boolean> {
  return inTurn('cut a vessel', async (document) => {
    const line = vesselOf(document, id)?.line;
    const parts = line === undefined ? null : await tracing.cut(line, arcLength);
    return (now) => (parts ? inParts(now, id, parts) : now);
  });
}

function inParts(document: Document, id: number, [first, second]: readonly [LineId, LineId]): Document {
  const vessel = vesselOf(document, id);
  if (!vessel) {
    return document;
  }
  const name = freshName(document, `${nameOf(vessel)} part`);
  return replaced(document, id, [
    { ...vessel, line: first, clicks: null },
    { line: second, name },
  ]);
}

/** Joins a second vessel to a first one, which keeps its name and colour. */
export function join(tracing: Tracing, id: number, other: number): Promise<boolean> {
  return inTurn('join two vessels', async (document) => {
    const [first, second] = [vesselOf(document, id), vesselOf(document, other)];
    if (!first || !second || id === other) {
      return (now) => now;
    }
    const line = await tracing.join(first.line, second.line);
    return (now) => without(replaced(now, id, [{ ...first, line, clicks: null }]), [other]);
  });
}
