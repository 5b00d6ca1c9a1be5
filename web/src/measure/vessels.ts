/** Reads and writes the marks of a vessel in the document. */
import type { LineId } from '../core/messages';
import { type Document, NO_MARKS, type VesselMarks } from '../state/document';

const byLine = (document: Document, line: LineId) => document.vessels.find((vessel) => vessel.line === line);

export function marksOf(document: Document, line: LineId): VesselMarks {
  const vessel = byLine(document, line);
  return (vessel && document.marks[vessel.id]) ?? NO_MARKS;
}

export function withMarks(document: Document, line: LineId, marks: VesselMarks): Document {
  const id = byLine(document, line)?.id;
  return id === undefined ? document : { ...document, marks: { ...document.marks, [id]: marks } };
}
