/** The lines of a document in another engine than the one that made them, as after a crash. */
import type { Asked } from '../core/asked';
import type { LineContent, LineId } from '../core/messages';
import type { Document } from '../state/document';

/** The document with lines of another engine, of the same content. Vessels whose lines the page does not hold are left out. */
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
