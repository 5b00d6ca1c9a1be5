/** Saves the vessels as a centerline file. */

import type { CenterlineKind } from '../core/messages';
import { centerlineFile } from '../edit/files';
import { document_, markSaved } from '../state/history';
import { saveAs } from './pictures';
import { studyFileName } from './study-file-names';

export async function saveCenterlines(kind: CenterlineKind): Promise<void> {
  const document = document_.value;
  saveAs(await centerlineFile(kind), studyFileName({ content: 'centerlines', ending: kind }));
  markSaved(document);
}

export const hasCenterlines = (): boolean => document_.value.vessels.some((vessel) => vessel.doubt === null);
