/** Buttons to save and open centerlines. */

import { SAVED_CENTERLINES } from '../core/generated/tables';
import { attempt } from '../output/by-key';
import { hasCenterlines, saveCenterlines } from '../output/session';
import { OpenMore } from './OpenButtons';

export function CenterlineFiles() {
  return (
    <div class="buttons">
      {SAVED_CENTERLINES.map((kind) => (
        <button
          key={kind}
          type="button"
          disabled={!hasCenterlines()}
          title="All vessels in the list except the doubtful ones"
          onClick={() => attempt(() => saveCenterlines(kind))}
        >
          {`Save .${kind}`}
        </button>
      ))}
      <OpenMore words="Open centerlines" />
    </div>
  );
}
