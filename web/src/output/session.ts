/** Saves the session. */

import { document_, markSaved } from '../state/history';
import { savedSession } from '../study/saving';
import { saveAs } from './pictures';
import { studyFileName } from './study-file-names';

/** The session is a markups file with an additional field, so 3D Slicer can open its vessels. */
export async function saveSession(): Promise<void> {
  const document = document_.value;
  const name = studyFileName({ content: 'session', ending: 'mrk.json' });
  saveAs(new Blob([await savedSession()], { type: 'application/json' }), name);
  markSaved(document);
}
