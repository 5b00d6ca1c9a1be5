/** The session as a file. */

import { savedSession } from '../session/saving';
import { document_, markSaved } from '../state/history';
import { saveAs } from './pictures';
import { studyFileName } from './study-file-names';

/** Markups with a field of their own: 3D Slicer opens the vessels of it. */
export async function saveSession(): Promise<void> {
  const document = document_.value;
  const name = studyFileName({ content: 'session', ending: 'mrk.json' });
  saveAs(new Blob([await savedSession()], { type: 'application/json' }), name);
  markSaved(document);
}
