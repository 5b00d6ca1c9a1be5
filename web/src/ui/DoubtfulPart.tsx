/** List of the doubtful branches with their reasons. The user accepts each or leaves it out. */

import type { DocumentVessel } from '../core/messages';
import { accept, leaveOut } from '../edit/branches';
import { countedDoubts, reasonOf, showDoubt, stepDoubt } from '../edit/doubts';
import { nameOf } from '../state/changes';
import { lengthOf } from '../state/lines';
import { hasMillimetres } from '../state/millimetres';
import { areDoubtfulShown, chosenDoubt, showDoubtful } from '../state/tool';
import { lighting } from './VesselRow';

export function DoubtfulPart({ vessels }: { readonly vessels: readonly DocumentVessel[] }) {
  const ids = vessels.map((vessel) => vessel.id);
  if (ids.length === 0) {
    return null;
  }
  return (
    <section class="doubtful-rows" aria-label="Doubtful branches">
      <h3 title={countedDoubts(vessels)}>
        {areDoubtfulShown.value ? countedDoubts(vessels) : `${ids.length} doubtful, left out`}
      </h3>
      <div class="buttons">
        <button
          type="button"
          aria-pressed={areDoubtfulShown.value}
          title={`Lists and draws them: ${countedDoubts(vessels)}`}
          onClick={() => showDoubtful(!areDoubtfulShown.value)}
        >
          Show them
        </button>
        <button
          type="button"
          title="Shows each doubtful branch with its reason (.)"
          onClick={() => stepDoubt(1)}
        >
          Review each
        </button>
        <button type="button" onClick={() => void accept(ids)}>
          Accept all
        </button>
        <button type="button" onClick={() => void leaveOut(ids)}>
          Leave all out
        </button>
      </div>
      {areDoubtfulShown.value && (
        <ul class="vessel-rows">
          {vessels.map((vessel) => (
            <DoubtfulRow key={vessel.id} vessel={vessel} />
          ))}
        </ul>
      )}
    </section>
  );
}

/** A row of the list: hovering highlights its branch in the views, a click shows the branch. */
function DoubtfulRow({ vessel }: { readonly vessel: DocumentVessel }) {
  const name = nameOf(vessel);
  return (
    <li class={vessel.id === chosenDoubt.value ? 'picked' : ''} {...lighting(vessel)}>
      <button
        type="button"
        class="name"
        title={`${vessel.doubt}. Click to show it`}
        aria-label={`Show ${name}, ${reasonOf(vessel)}`}
        onClick={() => void showDoubt(vessel)}
      >
        <span>{name}</span> <span class="doubt-reason">{reasonOf(vessel)}</span>
      </button>
      <span class="length" title={hasMillimetres.value ? 'Length (mm)' : 'Length'}>
        {lengthText(vessel)}
      </span>
      <button type="button" aria-label={`Accept ${name}`} onClick={() => void accept([vessel.id])}>
        ✓
      </button>
      <button type="button" aria-label={`Leave ${name} out`} onClick={() => void leaveOut([vessel.id])}>
        ✕
      </button>
    </li>
  );
}

/** The length without its unit, which the tooltip states; this leaves room for the reason. */
const lengthText = (vessel: DocumentVessel): string => lengthOf(vessel.line).toFixed(1);
