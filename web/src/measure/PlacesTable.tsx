/** Table of marked and suggested places, and the largest diameter of the vessel. */

import type { Profile } from '../core/messages';
import { cut } from '../edit/vessels';
import { moveTo } from '../state/cross-hair';
import type { VesselMarks } from '../state/document';
import { document_ } from '../state/history';
import { answers } from '../state/measuring';
import { placeTurn, togglePlaceTurn } from '../state/place-turn';
import * as store from '../state/store';
import { currentMarks, currentPlaces, currentVessel } from './current';
import { confirm, remove } from './editing';
import type { Kind, VesselPlace } from './marks';
import { COLORS } from './PlaceHandles';
import { sectionNumbers } from './sections';
import { area, doubtWords, meanings, mm, NOTHING, placeName, spread, withKnownUnits } from './words';

/** Kinds of places listed here; `StretchPart` lists the stretches. */
const LISTED: readonly Kind[] = ['place', 'reference', 'diameter'];

interface ProfileProps {
  readonly profile: Profile;
}

export function PlacesTable({ profile }: ProfileProps) {
  const marks = currentMarks.value;
  const places = currentPlaces.value.filter(({ kind }) => LISTED.includes(kind));
  const { widest } = profile;
  const doubts = widest ? sectionNumbers(profile, widest.at).flags : [];
  return (
    <section aria-label="Places">
      <h3>Places</h3>
      <NotMeasured profile={profile} />
      {places.map((place) => (
        <PlaceRow key={`${place.kind} ${place.slot}`} place={place} profile={profile} />
      ))}
      {widest && (
        <div class="place-row">
          <button type="button" class="link" onClick={() => moveTo(widest.at)}>
            longest diameter
          </button>
          <span>{`${mm(widest.diameter)} at ${mm(widest.at, 1)}`}</span>
          {doubts.length > 0 && <small title={meanings(profile, doubts)}>{doubts.join(', ')}</small>}
        </div>
      )}
      {marks && <NotSuggested marks={marks} profile={profile} />}
      <TurnButton />
    </section>
  );
}

/** The outer wall, both lumens at a flap, and parts of the vessel that could not be measured, with a button to cut the vessel there. */
function NotMeasured({ profile }: ProfileProps) {
  const id = document_.value.vessels.find(({ line }) => line === currentVessel.value?.line)?.id;
  return (
    <>
      {profile.outer_stretch && <p data-testid="outer-wall">{withKnownUnits(profile.outer_stretch)}</p>}
      {profile.flap_stretch && <p data-testid="flap">{withKnownUnits(profile.flap_stretch)}</p>}
      {profile.not_measured.map(({ cut_mm: at, words }) => (
        <p key={at} class="refused" data-testid="not-measured">
          {withKnownUnits(words)}{' '}
          {id !== undefined && (
            <button type="button" class="small" onClick={() => void cut(id, at)}>
              Cut here
            </button>
          )}
        </p>
      ))}
    </>
  );
}

/** Why no place, or a wider one, is suggested or marked; a narrower place is one click away. */
function NotSuggested({ marks, profile }: ProfileProps & { readonly marks: VesselMarks }) {
  const { not_suggested: suggesting, passed_over: narrower } = profile;
  const isMarked = marks.at !== null || marks.references.length > 0;
  const reasons = isMarked ? [answers.value.narrower].filter((words) => words !== null) : suggesting;
  return reasons.length > 0 ? (
    <p data-testid="not-suggested">
      {reasons.map(withKnownUnits).join(' ')}{' '}
      {narrower && (
        <button type="button" class="small" onClick={() => moveTo(narrower.at)}>
          {`Show ${mm(narrower.at, 1)}`}
        </button>
      )}
    </p>
  ) : null;
}

function TurnButton() {
  const turn = placeTurn.value;
  return (
    <button
      type="button"
      class="small"
      aria-pressed={turn !== null}
      title="Rotates the cut around this place, to show every diameter of the lumen (o)"
      onClick={() => void togglePlaceTurn()}
    >
      {`Turn about ${mm(turn?.at ?? store.pickedPlace.value, 1)}`}
    </button>
  );
}

function PlaceRow({ place, profile }: { readonly place: VesselPlace; readonly profile: Profile }) {
  const section = sectionNumbers(profile, place.at);
  const { diameter, uncertainty, shortest, longest, area: size, flags } = section;
  const doubts = doubtWords(section).join(', ');
  return (
    <div class="place-row" data-testid={`row-${place.kind}-${place.slot}`}>
      <button
        type="button"
        class="link in-colour"
        style={{ '--colour': COLORS[place.kind] }}
        onClick={() => moveTo(place.at)}
        title="Shows the section at this place"
      >
        {placeName(place)}
      </button>
      <span>{`${spread(diameter, uncertainty)} at ${mm(place.at, 1)}`}</span>
      <small title={meanings(profile, flags)}>
        {`${shortest?.toFixed(2) ?? NOTHING} to ${mm(longest)}, ${area(size)}${doubts && ` · ${doubts}`}`}
      </small>
      {place.isSuggestion ? (
        <button type="button" class="small" onClick={() => confirm(place)}>
          Confirm
        </button>
      ) : (
        <button
          type="button"
          class="small"
          aria-label={`Remove the ${placeName({ ...place, isConfirmed: false })}`}
          onClick={() => remove(place)}
        >
          ×
        </button>
      )}
    </div>
  );
}
