/** What was refused in the names of the page: the core counts points and vessels from 0. */
import { type About, Failure } from '../core/failure';
import type { Vector } from '../core/messages';
import { isClicked, nameOf } from './changes';
import type { Document, DocumentVessel } from './document';

type Clicked = DocumentVessel & { readonly clicks: readonly Vector[] };

/** The failure to trace some vessels, told with their names; a point that `before` has not is the one that was set. */
export function inNames(failure: Failure, vessels: readonly Clicked[], before: Document): Failure {
  const known = new Set(before.vessels.filter(isClicked).flatMap((vessel) => vessel.clicks));
  const { kind, found, expected, advice, about, more } = failure;
  const subject = about ? subjectOf(about, vessels, known) : failure.subject;
  return new Failure(kind, subject, found, expected, advice, more);
}

function subjectOf(about: About, vessels: readonly Clicked[], known: ReadonlySet<Vector>): string {
  const vessel = about.vessel === null ? null : vessels[about.vessel];
  if (!vessel) {
    // A click outside of the lumen is marked by the page.
    return 'this point';
  }
  if (about.point === null) {
    return `points of ${nameOf(vessel)}`;
  }
  const click = vessel.clicks[about.point];
  return click && known.has(click) ? `point ${about.point + 1} of ${nameOf(vessel)}` : 'this point';
}
