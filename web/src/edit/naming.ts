/** What was refused in the names of the page: the core counts points and vessels from 0. */
import { Failure } from '../core/failure';
import type { Vector } from '../core/messages';
import { isClicked, nameOf } from './changes';
import type { Document, DocumentVessel } from './document';

type Clicked = DocumentVessel & { readonly clicks: readonly Vector[] };

/** The failure to trace some vessels, told with their names; a point that `before` has not is the one that was set. */
export function inNames(failure: Failure, vessels: readonly Clicked[], before: Document): Failure {
  const known = new Set(before.vessels.filter(isClicked).flatMap((vessel) => vessel.clicks));
  const { kind, found, expected, mend, series, place, value } = failure;
  const more = { series, ...(place && { place }), ...(value !== null && { value }) };
  return new Failure(kind, subjectOf(failure.subject, vessels, known), found, expected, mend, more);
}

function subjectOf(subject: string, vessels: readonly Clicked[], known: ReadonlySet<Vector>): string {
  const [, point, number] = /^points?(?: (\d+))? of vessel (\d+)$/.exec(subject) ?? [];
  const vessel = vessels[Number(number)];
  if (!vessel) {
    // A click that lies in no lumen is called by its coordinates, which the page marks.
    return /^point \S/.test(subject) ? 'this point' : subject;
  }
  if (point === undefined) {
    return `points of ${nameOf(vessel)}`;
  }
  const click = vessel.clicks[Number(point)];
  return click && known.has(click) ? `point ${Number(point) + 1} of ${nameOf(vessel)}` : 'this point';
}
