/** Saves the session, and the vessels as a centerline file. */

import type { CenterlineKind } from '../core/messages';
import { centerlineFile } from '../edit/files';
import { document_, markSaved } from '../state/history';
import { savedSession } from '../study/saving';
import { studyFileName } from './file-names';
import { saveAs } from './pictures';

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
