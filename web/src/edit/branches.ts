/** Many vessels at once: all branches from a seed, and the vessels of a mask. */
import type { GivenFile, Vector } from '../core/messages';
import type { Tracing } from '../core/tracing';
import { notes } from '../state/store';
import { changed, freshName, vesselOf, without, withVessel } from './changes';
import { commitPlain, inTurn } from './committing';
import type { Document } from './document';

/** Adds all branches that a seed reaches; doubtful ones wait until they are accepted. */
export function addBranches(tracing: Tracing, seed: Vector): Promise<boolean> {
  return inTurn('add all branches from here', async (_, told) => {
    const branches = await tracing.traceFrom(seed, null, told);
    const add = (document: Document, { line, doubt }: (typeof branches)[number]) =>
      withVessel(document, { line, doubt, name: freshName(document, 'Branch') });
    return (now) => branches.reduce(add, now);
  });
}

/** Accepts branches that are doubtful. */
export function accept(ids: readonly number[]): Promise<boolean> {
  const words = ids.length === 1 ? 'accept a branch' : 'accept branches';
  return commitPlain(words, (document) =>
    ids.reduce((now, id) => changed(now, id, { doubt: null }), document),
  );
}

/** Leaves branches out that are doubtful. */
export function leaveOut(ids: readonly number[]): Promise<boolean> {
  const words = ids.length === 1 ? 'leave a branch out' : 'leave branches out';
  const isDoubtful = (document: Document) => (id: number) => Boolean(vesselOf(document, id)?.doubt);
  return commitPlain(words, (document) => without(document, ids.filter(isDoubtful(document))));
}

/** Adds the vessels of a mask; what was odd about it is told among the notes. */
export function addMask(tracing: Tracing, files: readonly GivenFile[]): Promise<boolean> {
  return inTurn('add the vessels of a mask', async (_, told) => {
    const mask = await tracing.traceMask(files, told);
    notes.value = [...new Set([...notes.value, ...mask.notes])];
    const add = (document: Document, { line, name }: (typeof mask.lines)[number]) =>
      withVessel(document, { line, name: name || freshName(document, 'Mask') });
    return (now) => mask.lines.reduce(add, now);
  });
}
