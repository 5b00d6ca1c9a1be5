/** Buttons to save and open centerlines. */

import type { CenterlineKind } from '../core/messages';
import { attempt } from '../output/by-key';
import { hasCenterlines, saveCenterlines } from '../output/session';
import { OpenMore } from './OpenButtons';

const KINDS: readonly (readonly [CenterlineKind, string])[] = [
  ['vtp', 'Save .vtp'],
  ['mrk.json', 'Save .mrk.json'],
];

export function CenterlineFiles() {
  return (
    <div class="buttons">
      {KINDS.map(([kind, words]) => (
        <button
          key={kind}
          type="button"
          disabled={!hasCenterlines()}
          title="All vessels in the list except the doubtful ones"
          onClick={() => attempt(() => saveCenterlines(kind))}
        >
          {words}
        </button>
      ))}
      <OpenMore words="Open centerlines" />
    </div>
  );
}
