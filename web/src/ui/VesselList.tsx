/** The list of vessels: their names, colours and lengths, and what can be done with all of them. */

import { engine } from '../client/shared';
import type { DocumentVessel } from '../core/messages';
import { namesToOffer } from '../edit/anatomy';
import { accept, findVessels, leaveOut } from '../edit/branches';
import { setBridge } from '../edit/clicks';
import { showDoubt, stepDoubt } from '../edit/doubts';
import { lengthOf } from '../edit/lines';
import { isListOpen } from '../edit/list-open';
import { chosenDoubt, isTracing, toggleTool } from '../edit/mode';
import { performAny } from '../edit/performing';
import { STOPPER } from '../edit/stoppers';
import { listedVessels } from '../edit/vessel-order';
import { remove } from '../edit/vessels';
import { doubtful, nameOf } from '../state/changes';
import { document_ } from '../state/history';
import { hasMillimetres } from '../state/millimetres';
import { isTreeShown } from '../state/tidy';
import { CenterlineFiles } from './CenterlineFiles';
import { TidyPart } from './TidyPart';
import { lighting, NAMES_TO_OFFER, VesselRow } from './VesselRow';

export function VesselList() {
  if (!isListOpen.value) {
    return null;
  }
  const vessels = document_.value.vessels.filter((vessel) => vessel.doubt === null);
  return (
    <aside class="vessels" aria-label="List of vessels">
      <Closing />
      <Means />
      <Doubtful vessels={doubtful(document_.value)} />
      <TidyPart />
      {vessels.length === 0 ? <p class="notice">No vessels yet.</p> : null}
      {vessels.length > 1 && <TreeChoice />}
      <ul class="vessel-rows">
        {listedVessels.value.map(({ vessel, depth }) => (
          <VesselRow key={vessel.id} vessel={vessel} depth={depth} />
        ))}
      </ul>
      <datalist id={NAMES_TO_OFFER}>
        {namesToOffer(vessels.map((vessel) => vessel.name)).map((name) => (
          <option key={name} value={name} />
        ))}
      </datalist>
      {vessels.length > 1 && (
        <div class="buttons">
          <button
            type="button"
            onClick={() =>
              void remove(
                engine,
                vessels.map((vessel) => vessel.id),
              )
            }
          >
            Delete all
          </button>
        </div>
      )}
      <CenterlineFiles />
    </aside>
  );
}

/** Shows the list as a tree, or as the vessels came. */
function TreeChoice() {
  return (
    <div class="buttons">
      <label title="Branches stand under the vessel that they hang on, the widest first">
        <input
          type="checkbox"
          checked={isTreeShown.value}
          onChange={(event) => {
            isTreeShown.value = event.currentTarget.checked;
          }}
        />
        {`As a tree, the widest first${hasMillimetres.value ? ' (diameter × length, mm)' : ''}`}
      </label>
    </div>
  );
}

/** The way out of the list. */
function Closing() {
  return (
    <div class="buttons">
      <span class="spring" />
      <button
        type="button"
        aria-label="Close the list"
        onClick={() => {
          isListOpen.value = false;
        }}
      >
        ✕
      </button>
    </div>
  );
}

/** How vessels come to the list. */
function Means() {
  return (
    <div class="buttons">
      <button
        type="button"
        title="All vessels that are brighter than the tissue around them"
        onClick={() => void findVessels(engine)}
      >
        Find all vessels
      </button>
      <button type="button" title="From the cross-hair (b)" onClick={() => performAny(engine, 'branches')}>
        All branches from here
      </button>
      {!isTracing() && (
        <button type="button" title={STOPPER} onClick={() => toggleTool('stopper')}>
          Stopper
        </button>
      )}
      <label title="A vessel goes on where no lumen is seen between two clicks, as in an occlusion; without it such a click is refused">
        <input
          type="checkbox"
          checked={document_.value.bridge}
          onChange={(event) => void setBridge(engine, event.currentTarget.checked)}
        />
        Bridge gaps without lumen
      </label>
    </div>
  );
}

/** Branches that are to be accepted or left out. */
function Doubtful({ vessels }: { readonly vessels: readonly DocumentVessel[] }) {
  const ids = vessels.map((vessel) => vessel.id);
  if (ids.length === 0) {
    return null;
  }
  return (
    <section class="doubtful-rows" aria-label="Doubtful branches">
      <h3>{ids.length === 1 ? '1 doubtful branch' : `${ids.length} doubtful branches`}</h3>
      {[...new Set(vessels.map((vessel) => vessel.doubt))].map((doubt) => (
        <p key={doubt} class="notice">
          {`${doubt?.[0]?.toUpperCase() ?? ''}${doubt?.slice(1) ?? ''}.`}
        </p>
      ))}
      <div class="buttons">
        <button type="button" title="Each in turn (.), with its reason" onClick={() => stepDoubt(engine, 1)}>
          Look at each
        </button>
        <button type="button" onClick={() => void accept(engine, ids)}>
          Accept all
        </button>
        <button type="button" onClick={() => void leaveOut(engine, ids)}>
          Leave all out
        </button>
      </div>
      <ul class="vessel-rows">
        {vessels.map((vessel) => (
          <li key={vessel.id} class={vessel.id === chosenDoubt.value ? 'picked' : ''} {...lighting(vessel)}>
            <button
              type="button"
              class="name"
              title={vessel.doubt ?? ''}
              aria-label={`Show ${nameOf(vessel)}`}
              onClick={() => void showDoubt(engine, vessel)}
            >
              {nameOf(vessel)}
            </button>
            <span class="length">{lengthText(vessel)}</span>
            <button
              type="button"
              aria-label={`Accept ${nameOf(vessel)}`}
              onClick={() => void accept(engine, [vessel.id])}
            >
              ✓
            </button>
            <button
              type="button"
              aria-label={`Leave ${nameOf(vessel)} out`}
              onClick={() => void leaveOut(engine, [vessel.id])}
            >
              ✕
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

const lengthText = (vessel: DocumentVessel): string =>
  `${lengthOf(vessel.line).toFixed(1)}${hasMillimetres.value ? ' mm' : ''}`;
