/** The clicks of vessels. After each edit the vessels that were clicked are traced anew; a click that is refused changes nothing. */
import type { Vector } from '../core/messages';
import type { Tracing } from '../core/tracing';
import { changed, freshId, freshName, vesselOf, without, withVessel } from './changes';
import { commit, commitPlain } from './committing';
import type { Document } from './document';
import { document_ } from './history';

/** What a vessel has for a line until it is traced. */
const UNTRACED = -1;
/** The least number of clicks of a vessel. */
const FEWEST = 2;

/**
 * Begins a vessel with two clicks or more; gives its id, or null where it was refused. `begun` hears of it also where the
 * user bridges a gap after that.
 */
export async function beginVessel(
  tracing: Tracing,
  clicks: readonly Vector[],
  begun: (id: number) => void = () => undefined,
): Promise<number | null> {
  const id = freshId(document_.value);
  const edit = (document: Document) =>
    withVessel(document, { id, line: UNTRACED, name: freshName(document, 'Vessel'), clicks });
  const done = await commit(tracing, 'begin a vessel', edit, () => begun(id));
  return done ? id : null;
}

/** Adds a click at the end of a vessel. */
export function addClick(tracing: Tracing, id: number, point: Vector): Promise<boolean> {
  return edited(tracing, 'add a point', id, (clicks) => [...clicks, point]);
}

/** Adds a click before another one. */
export function insertClick(tracing: Tracing, id: number, before: number, point: Vector): Promise<boolean> {
  return edited(tracing, 'add a point', id, (clicks) => clicks.toSpliced(before, 0, point));
}

/** Gives a vessel that was not clicked points, between which it is traced from then on. */
export function giveClicks(tracing: Tracing, id: number, clicks: readonly Vector[]): Promise<boolean> {
  return commit(tracing, 'add a point', (document) => changed(document, id, { clicks }));
}

export function moveClick(tracing: Tracing, id: number, number: number, point: Vector): Promise<boolean> {
  return edited(tracing, 'move a point', id, (clicks) => clicks.with(number, point));
}

/** Removes a click; a vessel that would have only one left goes with it. */
export function removeClick(tracing: Tracing, id: number, number: number): Promise<boolean> {
  const clicks = vesselOf(document_.value, id)?.clicks ?? [];
  return clicks.length > FEWEST
    ? edited(tracing, 'remove a point', id, (all) => all.toSpliced(number, 1))
    : commitPlain('remove a point', (document) => without(document, [id]));
}

/** Whether vessels go on where no lumen is seen. */
export function setBridge(tracing: Tracing, bridge: boolean): Promise<boolean> {
  return commit(tracing, bridge ? 'bridge gaps' : 'leave gaps', (document) => ({ ...document, bridge }));
}

function edited(
  tracing: Tracing,
  words: string,
  id: number,
  edit: (clicks: readonly Vector[]) => readonly Vector[],
): Promise<boolean> {
  const after = (document: Document) => {
    const clicks = vesselOf(document, id)?.clicks;
    return clicks ? changed(document, id, { clicks: edit(clicks) }) : document;
  };
  return commit(tracing, words, after);
}
