/** Copies the lines of a document to another engine, as after a crash. */
import type { Asked } from '../core/asked';
import type { LineContent, LineId } from '../core/messages';
import type { Document } from '../state/document';

/** The document with the lines of the other engine. Vessels without loaded lines are dropped. */
export async function handedOver(
  other: Asked,
  document: Document,
  contents: ReadonlyMap<LineId, LineContent>,
): Promise<Document> {
  const vessels = document.vessels.map(async (vessel) => {
    const content = contents.get(vessel.line);
    return content ? [{ ...vessel, line: await other.ask('add_line', content) }] : [];
  });
  return { ...document, vessels: (await Promise.all(vessels)).flat() };
}
