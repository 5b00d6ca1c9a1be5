/** Edits that need no engine: each of them gives another document. */
import type { LineId, Vector, VesselReport } from '../core/messages';
import type { Stopper } from '../core/tracing';
import { type Document, type DocumentVessel, EMPTY } from './document';
import { nextColor } from './palette';

let lastId = 0;

/** An id that no vessel of the study had before. */
export function freshId(document: Document): number {
  lastId = Math.max(lastId, ...document.vessels.map((vessel) => vessel.id)) + 1;
  return lastId;
}

/** What is known of a vessel that comes to a document. */
export type NewVessel = Pick<DocumentVessel, 'line'> & Partial<DocumentVessel>;

/** The document with one more vessel at its end, in the next colour. */
export function withVessel(document: Document, given: NewVessel): Document {
  const vessel: DocumentVessel = {
    id: given.id ?? freshId(document),
    name: '',
    color: nextColor(document.vessels),
    isHidden: false,
    clicks: null,
    doubt: null,
    ...given,
  };
  return { ...document, vessels: [...document.vessels, vessel] };
}

export const withVessels = (document: Document, given: readonly NewVessel[]): Document =>
  given.reduce(withVessel, document);

/** The document that a study begins with. */
export function documentOf(vessels: readonly VesselReport[]): Document {
  lastId = 0;
  return withVessels(
    EMPTY,
    vessels.map(({ line, name }) => ({ line, name })),
  );
}

export const vesselOf = (document: Document, id: number | null): DocumentVessel | null =>
  document.vessels.find((vessel) => vessel.id === id) ?? null;

/** The document with a vessel changed; the same one where the vessel is not there. */
export function changed(document: Document, id: number, to: Partial<DocumentVessel>): Document {
  return vesselOf(document, id)
    ? {
        ...document,
        vessels: document.vessels.map((vessel) => (vessel.id === id ? { ...vessel, ...to } : vessel)),
      }
    : document;
}

/** The document without some vessels and what was marked on them. */
export function without(document: Document, ids: readonly number[]): Document {
  const marks = Object.entries(document.marks).filter(([id]) => !ids.includes(Number(id)));
  return {
    ...document,
    vessels: document.vessels.filter((vessel) => !ids.includes(vessel.id)),
    marks: Object.fromEntries(marks),
  };
}

/** The document with other vessels in the place of one, which loses its marks: their places lie elsewhere. */
export function replaced(document: Document, id: number, by: readonly NewVessel[]): Document {
  const at = document.vessels.findIndex((vessel) => vessel.id === id);
  const rest = without(document, [id]);
  const grown = withVessels(rest, by);
  const [kept, added] = [rest.vessels, grown.vessels.slice(rest.vessels.length)];
  return { ...rest, vessels: [...kept.slice(0, at), ...added, ...kept.slice(at)] };
}

/** What the list and the files call a vessel. */
export const nameOf = ({ name, id }: DocumentVessel): string => name || `vessel ${id}`;

/** A name that no vessel has: `Vessel 3`. */
export function freshName(document: Document, kind: string): string {
  const taken = new Set(document.vessels.map((vessel) => vessel.name));
  for (let n = 1; ; n++) {
    if (!taken.has(`${kind} ${n}`)) {
      return `${kind} ${n}`;
    }
  }
}

/** The vessels of the tree that is shown, in their order. */
export const shownVessels = (document: Document): readonly DocumentVessel[] =>
  document.vessels.filter((vessel) => !vessel.isHidden && vessel.doubt === null);

export const doubtful = (document: Document): readonly DocumentVessel[] =>
  document.vessels.filter((vessel) => vessel.doubt !== null);

/** Whether a vessel was clicked: its line is traced anew when one of its clicks changes. */
export const isClicked = (
  vessel: DocumentVessel,
): vessel is DocumentVessel & { readonly clicks: readonly Vector[] } => vessel.clicks !== null;

/** The document with lines for some of its vessels, by their ids. */
export function withLines(document: Document, lines: ReadonlyMap<number, LineId>): Document {
  const vessels = document.vessels.map((vessel) => {
    const line = lines.get(vessel.id);
    return line === undefined || line === vessel.line ? vessel : { ...vessel, line };
  });
  return { ...document, vessels };
}

/** The document with another stopper in the place of one, or with one more at the end; none removes it. */
export function withStopper(document: Document, number: number, stopper: Stopper | null): Document {
  const stoppers = [...document.stoppers];
  stoppers.splice(number, 1, ...(stopper ? [stopper] : []));
  return { ...document, stoppers };
}
