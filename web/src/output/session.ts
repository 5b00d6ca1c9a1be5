/** The session as a file. */
import { document_, markSaved } from '../edit/history';
import { savedSession } from '../session/saving';
import { saveAs } from './pictures';

/** Markups with a field of their own: 3D Slicer opens the vessels of it. */
export async function saveSession(): Promise<void> {
  const document = document_.value;
  saveAs(new Blob([await savedSession()], { type: 'application/json' }), 'lumencut-session.mrk.json');
  markSaved(document);
}
