/** Saves the session, the report, and the vessels as a centerline file, by a button or a key. */
import type { CenterlineKind } from '../core/messages';
import type { Action } from '../input/bindings';
import { nameOf } from '../state/changes';
import { document_, markSaved } from '../state/history';
import { report, showProblem } from '../state/store';
import { savedSession } from '../study/saving';
import { engine } from '../worker/engine';
import { studyFileName } from './file-names';
import { saveAs } from './pictures';
import { saveReport } from './report';

/** The session is a markups file with an additional field, so 3D Slicer can open its vessels. */
export async function saveSession(): Promise<void> {
  const document = document_.value;
  const name = studyFileName({ content: 'session', ending: 'mrk.json' });
  saveAs(new Blob([await savedSession()], { type: 'application/json' }), name);
  markSaved(document);
}

export async function saveCenterlines(kind: CenterlineKind): Promise<void> {
  const document = document_.value;
  saveAs(await centerlineFile(kind), studyFileName({ content: 'centerlines', ending: kind }));
  markSaved(document);
}

export const hasCenterlines = (): boolean => document_.value.vessels.some((vessel) => vessel.doubt === null);

/** A centerline file of all vessels, also hidden ones, but without doubtful ones. */
export async function centerlineFile(kind: CenterlineKind): Promise<Blob> {
  const vessels = document_.value.vessels.filter((vessel) => vessel.doubt === null);
  const lines = vessels.map((vessel) => ({ line: vessel.line, name: nameOf(vessel) }));
  return new Blob([(await engine.ask('write_lines', { lines, kind })).bytes], {
    type: 'application/octet-stream',
  });
}

/** Saves the session or the report, if the action asks for it. Returns whether it does. */
export function saveByKey(action: Action): boolean {
  const save = { 'save session': saveSession, 'save report': saveReport }[action as string];
  if (save && report.value) {
    attempt(save);
  }
  return save !== undefined;
}

/** Saves; if saving fails, the page shows why. */
export function attempt(save: () => Promise<void>): void {
  save().catch(showProblem);
}
