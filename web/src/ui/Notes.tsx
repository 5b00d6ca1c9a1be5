/** Notes about the files, and doubts about vessels: those of one kind under one line, each with a button that shows its place. */

import { nameOf } from '../state/changes';
import { openAgain } from '../state/opened';
import { type PlacedDoubt, placedDoubts } from '../state/placed-doubts';
import { goToVessel } from '../state/shown';
import * as store from '../state/store';
import { useClosing } from './closing-menu';

export function Notes() {
  const menu = useClosing();
  const notes = store.notes.value;
  const kinds = placedDoubts.value;
  const count = notes.length + kinds.length;
  if (count === 0) {
    return null;
  }
  return (
    <details class="menu upwards" ref={menu}>
      <summary>{count === 1 ? '1 note' : `${count} notes`}</summary>
      <ul class="menu-body">
        {notes.map((note) => (
          <li key={note}>{note}</li>
        ))}
        {store.report.value?.can_reorder && (
          <li>
            <button type="button" onClick={() => void openAgain({ reorder: true })}>
              Put the points in order
            </button>
          </li>
        )}
        {kinds.map(([kind, doubts]) => (
          <li key={kind}>
            {`${doubts.length === 1 ? '1 place' : `${doubts.length} places`} where a vessel ${kind}`}
            <div class="buttons">
              {doubts.map((doubt) => (
                <Place key={`${doubt.line} ${doubt.at}`} doubt={doubt} />
              ))}
            </div>
          </li>
        ))}
      </ul>
    </details>
  );
}

function Place({ doubt: { vessel, at, words } }: { readonly doubt: PlacedDoubt }) {
  return (
    <button type="button" class="small stays" title={words} onClick={() => goToVessel(vessel.id, at)}>
      {`${nameOf(vessel)}${at === null ? '' : `, ${at.toFixed(0)} mm`}`}
    </button>
  );
}
