/** Panel with the measurements of the picked vessel. */

import { currentProfile, currentVessel } from '../measure/current';
import { PlacesTable } from '../measure/PlacesTable';
import { RulersPart } from '../measure/Rulers';
import { StretchPart } from '../measure/StretchPart';
import { mm, unitless } from '../measure/words';
import { giveFwhm } from '../state/profiles';
import { goToVessel, tree } from '../state/shown';
import * as store from '../state/store';
import { BestViewButton } from './BestViewButton';
import { LineDoubts } from './LineDoubts';
import { StenosisPart } from './StenosisPart';

export function NumbersPanel() {
  const profile = currentProfile.value;
  return (
    <div class="numbers-panel" data-testid="numbers">
      <VesselChoice />
      <Doubts />
      {unitless() && <p data-testid="unitless">{unitless()}</p>}
      {profile && (
        <>
          <StenosisPart />
          <PlacesTable profile={profile} />
          <StretchPart profile={profile} />
        </>
      )}
      <RulersPart />
      {profile && <Blur fwhm={profile.fwhm} source={profile.fwhm_source} />}
      {profile && <p data-testid="walls">{`Walls: ${profile.wall_source}.`}</p>}
      {profile && <p data-testid="imaging">{`Imaging: ${store.report.value?.volume?.scan}.`}</p>}
    </div>
  );
}

function Doubts() {
  const { id, line } = tree.value[store.pickedVessel.value ?? -1] ?? {};
  const doubts = store.vesselDoubts.value.filter((doubt) => doubt.line === line);
  return id === undefined || doubts.length === 0 ? null : (
    <p class="doubts" data-testid="line-doubts">
      <LineDoubts key={line} id={id} words="The line:" doubts={doubts} />
    </p>
  );
}

function VesselChoice() {
  const vessel = currentVessel.value;
  const vessels = store.report.value?.vessels ?? [];
  return (
    <div class="vessel-choice">
      <label>
        Vessel
        <select
          value={String(store.pickedVessel.value ?? '')}
          onChange={(event) => pick(Number(event.currentTarget.value))}
        >
          {store.pickedVessel.value === null && <option value="">none</option>}
          {vessels.map(({ line, name }, n) => (
            <option key={line} value={String(n)}>
              {name || `vessel ${n + 1}`}
            </option>
          ))}
        </select>
        {vessel && <span>{mm(vessel.length, 1)}</span>}
      </label>
      {vessel && <BestViewButton />}
    </div>
  );
}

function pick(vessel: number): void {
  const shown = tree.value[vessel];
  if (shown) {
    goToVessel(shown.id, null);
  }
}

/** Shows the FWHM that is used for measuring, with a field to enter a known value. */
function Blur({ fwhm, source }: { readonly fwhm: number; readonly source: string }) {
  const give = (field: HTMLInputElement) => {
    // If the input is invalid, the browser shows why.
    if (field.reportValidity()) {
      giveFwhm(field.value === '' ? null : Number(field.value));
    }
  };
  return (
    <section aria-label="Blur of the scan">
      <h3>Blur of the scan</h3>
      <p>{`FWHM of the point spread function: ${mm(fwhm)}, ${source}.`}</p>
      <label title="Enter the FWHM if you know it; if empty, the estimate is used">
        Known FWHM
        <input
          class="number"
          type="number"
          min="0.05"
          max="20"
          step="any"
          placeholder="estimated"
          value={source === 'given' ? String(fwhm) : ''}
          onChange={(event) => give(event.currentTarget)}
        />
        mm
      </label>
    </section>
  );
}
