/** Sends edits to the engine, in the order of the queue. */
import type { AfterEdit, DocumentVessel, Edit, Edited, GivenFile } from '../core/messages';
import { afterEdit } from '../state/changes';
import type { Document } from '../state/document';
import { storeSummary } from '../state/drawing';
import { editQueue, keepAnswer, type Work } from '../state/edit-queue';
import { document_ } from '../state/history';
import { engine } from '../worker/engine';

export function commitPlain(words: string, edit: (document: Document) => Document): Promise<boolean> {
  return isDone(editQueue.add('plain', () => ({ words, after: edit(document_.value), result: words })));
}

interface EditOptions {
  readonly mask?: readonly GivenFile[];
  readonly renamed?: (vessel: DocumentVessel) => DocumentVessel;
  /** Called when the edit has changed the document, also if the user first bridged a gap. */
  readonly then?: (edited: Edited) => void;
  readonly bridging?: boolean;
}

/** Sends an edit to the engine; returns null if it was not done. Changes made in the page meanwhile are kept. */
export function commit(edit: Edit, options: EditOptions = {}): Promise<AfterEdit | null> {
  const { mask, then, renamed = (vessel) => vessel, bridging = false } = options;
  const files = mask && { mask };
  const work: Work<AfterEdit> = async (onProgress) => {
    const ask = ({ vessels, stoppers, bridge, bone_hidden, dark }: Document) =>
      engine.ask(
        'edit',
        { document: { vessels, stoppers, bridge, bone_hidden, dark }, edit, bridging },
        { onProgress, ...files },
      );
    const answer = await latest(ask);
    // The engine displays the vessel names that it knows, so renamed vessels must be displayed again.
    const edited = withNames(answer.edited, renamed);
    const after = afterEdit(document_.value, edited);
    const also = () => {
      storeSummary(edited);
      then?.(edited);
    };
    return { words: edited.words, after, result: answer, answer, also };
  };
  return editQueue.add(edit.kind, work, () => void commit(edit, { ...options, bridging: true }));
}

function withNames(edited: Edited, renamed: (vessel: DocumentVessel) => DocumentVessel): Edited {
  const { document, added } = edited;
  const vessels = document.vessels.map((one) => (added.includes(one.id) ? renamed(one) : one));
  return { ...edited, document: { ...document, vessels } };
}

/** Repeats the request if the document changed meanwhile, for example by redo. */
async function latest(ask: (document: Document) => Promise<AfterEdit>): Promise<AfterEdit> {
  for (;;) {
    const before = document_.value;
    const answer = await ask(before);
    const now = document_.value;
    if (isSame(now, before)) {
      return answer;
    }
    keepAnswer(answer);
  }
}

const isSame = (one: Document, other: Document): boolean =>
  one.vessels === other.vessels &&
  one.stoppers === other.stoppers &&
  one.bridge === other.bridge &&
  one.bone_hidden === other.bone_hidden &&
  one.dark === other.dark;

export const isDone = (edit: Promise<unknown>): Promise<boolean> => edit.then((result) => result !== null);
