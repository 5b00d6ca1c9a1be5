/** Copies the centerlines of a document to another engine, for example after a crash. */
import type { Asked } from '../core/asked';
import type { LineContent, LineId } from '../core/messages';
import type { Document } from '../state/document';

/** The document with line numbers of the other engine. Vessels whose lines were not loaded are dropped. */
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
