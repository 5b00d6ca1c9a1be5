import { SAVED_CENTERLINES } from '../core/generated/tables';
import { findVessels } from '../edit/branches';
import { STOPPER, setBridge } from '../edit/clicks';
import { performAny } from '../edit/performing';
import { namesToOffer, remove } from '../edit/vessels';
import { attempt, hasCenterlines, saveCenterlines } from '../output/save-actions';
import { doubtful } from '../state/changes';
import { document_ } from '../state/history';
import { findAllTitle, kind } from '../state/kind';
import { hasMillimetres } from '../state/millimetres';
import { isListOpen, toggleList } from '../state/panels';
import { chooseTree, isTreeShown, listedVessels } from '../state/tidying';
import { isTracing, toggleTool } from '../state/tool';
import { DarkSwitch } from './DarkSwitch';
import { DoubtfulPart } from './DoubtfulPart';
import { OpenMore } from './OpenButtons';
import { TidyPart } from './TidyPart';
import { VeinsPart } from './VeinsPart';
import { NAMES_TO_OFFER, VesselRow } from './VesselRow';

export function VesselList() {
  if (!isListOpen.value) {
    return null;
  }
  const vessels = document_.value.vessels.filter((vessel) => vessel.doubt === null);
  return (
    <aside class="vessels" aria-label="List of vessels">
      <Closing />
      <AddButtons />
      <DoubtfulPart vessels={doubtful(document_.value)} />
      <TidyPart />
      <VeinsPart />
      {document_.value.vessels.length === 0 ? <p class="notice">No {kind.value.several} yet.</p> : null}
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
          <button type="button" onClick={() => void remove(vessels.map((vessel) => vessel.id))}>
            Delete all
          </button>
        </div>
      )}
      <CenterlineFiles />
    </aside>
  );
}

function TreeChoice() {
  return (
    <div class="buttons">
      <label title="Lists each branch under the vessel that it leaves, the widest branch first">
        <input
          type="checkbox"
          checked={isTreeShown.value}
          onChange={(event) => chooseTree(event.currentTarget.checked)}
        />
        {`As a tree, the widest first${hasMillimetres.value ? ' (diameter × length, mm)' : ''}`}
      </label>
    </div>
  );
}

function Closing() {
  return (
    <div class="buttons">
      <span class="spring" />
      <button type="button" aria-label="Close the list" onClick={toggleList}>
        ✕
      </button>
    </div>
  );
}

function AddButtons() {
  return (
    <div class="buttons">
      <button type="button" title={findAllTitle()} onClick={() => void findVessels()}>
        Find all {kind.value.several}
      </button>
      <button
        type="button"
        title="Searches from the cross-hair if you placed it, otherwise from your next click (b)"
        onClick={() => performAny('branches')}
      >
        All branches from here
      </button>
      {!isTracing() && (
        <button type="button" title={STOPPER} onClick={() => toggleTool('stopper')}>
          Stopper
        </button>
      )}
      <label title="Continues a vessel where no lumen is visible between two clicks, as in an occlusion. Otherwise such a click is rejected.">
        <input
          type="checkbox"
          checked={document_.value.bridge}
          onChange={(event) => void setBridge(event.currentTarget.checked)}
        />
        Bridge gaps without lumen
      </label>
      <DarkSwitch />
    </div>
  );
}

function CenterlineFiles() {
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
