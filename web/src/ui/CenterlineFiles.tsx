/** Vessels as files, and files as vessels. */

import { engine } from '../client/shared';
import { Failure } from '../core/failure';
import type { CenterlineKind } from '../core/messages';
import { centerlineFile } from '../edit/files';
import { saveAs } from '../output/pictures';
import { studyFileName } from '../output/study-file-names';
import { document_, markSaved } from '../state/history';
import { problem } from '../state/store';
import { OpenMore } from './OpenButtons';

const KINDS: readonly (readonly [CenterlineKind, string])[] = [
  ['vtp', 'Save .vtp'],
  ['mrk.json', 'Save .mrk.json'],
];

export function CenterlineFiles() {
  const isEmpty = document_.value.vessels.every((vessel) => vessel.doubt !== null);
  return (
    <div class="buttons">
      {KINDS.map(([kind, words]) => (
        <button
          key={kind}
          type="button"
          disabled={isEmpty}
          title="All vessels of the list, without the doubtful ones"
          onClick={() => void save(kind)}
        >
          {words}
        </button>
      ))}
      <OpenMore words="Open centerlines" />
    </div>
  );
}

async function save(kind: CenterlineKind): Promise<void> {
  const document = document_.value;
  try {
    saveAs(await centerlineFile(engine, kind), studyFileName({ content: 'centerlines', ending: kind }));
    markSaved(document);
  } catch (error) {
    problem.value = Failure.of(error);
  }
}
