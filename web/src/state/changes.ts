/** Reads documents, applies edits that the engine has made, and chooses colours of vessels. */
import { PALETTE } from '../core/generated/tables';
import type { DocumentVessel, Edited } from '../core/messages';
import type { Document } from './document';

export const vesselOf = (document: Document, id: number | null): DocumentVessel | null =>
  document.vessels.find((vessel) => vessel.id === id) ?? null;

export function changed(document: Document, id: number, to: Partial<DocumentVessel>): Document {
  return vesselOf(document, id)
    ? {
        ...document,
        vessels: document.vessels.map((vessel) => (vessel.id === id ? { ...vessel, ...to } : vessel)),
      }
    : document;
}

/** The document after an edit. Unchanged parts stay the same objects; without any change, so does the document. */
export function afterEdit(now: Document, { document, without_marks: lost }: Edited): Document {
  const vessels = kept(now.vessels, document.vessels);
  const stoppers = kept(now.stoppers, document.stoppers);
  const isSame =
    vessels === now.vessels &&
    stoppers === now.stoppers &&
    document.bridge === now.bridge &&
    document.bone_hidden === now.bone_hidden &&
    document.dark === now.dark &&
    lost.length === 0;
  if (isSame) {
    return now;
  }
  const marks = Object.entries(now.marks).filter(([id]) => !lost.includes(Number(id)));
  const { bridge, bone_hidden, dark } = document;
  return { ...now, vessels, stoppers, bridge, bone_hidden, dark, marks: Object.fromEntries(marks) };
}

function kept<T>(before: readonly T[], after: readonly T[]): readonly T[] {
  const known = new Map(before.map((one) => [JSON.stringify(one), one]));
  const all = after.map((one) => known.get(JSON.stringify(one)) ?? one);
  return all.length === before.length && all.every((one, n) => one === before[n]) ? before : all;
}

export const nameOf = ({ name, id }: DocumentVessel): string => name || `vessel ${id}`;

export const shownVessels = (document: Document): readonly DocumentVessel[] =>
  document.vessels.filter((vessel) => !vessel.isHidden && vessel.doubt === null);

export const doubtful = (document: Document): readonly DocumentVessel[] =>
  document.vessels.filter((vessel) => vessel.doubt !== null);

export { PALETTE };

export const DOUBTFUL = '#ffa500';

export function nextColor(vessels: readonly DocumentVessel[]): string {
  const counts = PALETTE.map(([color]) => vessels.filter((vessel) => vessel.color === color).length);
  return PALETTE[counts.indexOf(Math.min(...counts))]?.[0] ?? '#ffffff';
}
