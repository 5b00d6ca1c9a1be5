/** The marked and suggested places of a vessel with their numbers, and the widest place. */
import { engine } from '../client/shared';
import type { Profile } from '../core/messages';
import { moveTo } from '../link/along';
import { placeTurn, togglePlaceTurn } from '../state/place-turn';
import * as store from '../state/store';
import { currentMarks, currentPlaces } from './current';
import { confirm, remove } from './editing';
import { meanings } from './flags';
import type { Place } from './marks';
import { COLORS } from './PlaceHandles';
import { sectionNumbers } from './sections';
import { area, doubtWords, mm, NOTHING, placeName, spread, told } from './words';

export function PlacesTable({ profile }: { readonly profile: Profile }) {
  const marks = currentMarks.value;
  const places = currentPlaces.value.filter(({ kind }) => kind === 'place' || kind === 'reference');
  const { widest } = profile;
  const doubts = widest ? sectionNumbers(profile, widest.at).flags : [];
  return (
    <section aria-label="Places">
      <h3>Places</h3>
      {places.map((place) => (
        <PlaceRow key={`${place.kind} ${place.slot}`} place={place} profile={profile} />
      ))}
      {widest && (
        <div class="place-row">
          <button type="button" class="link" onClick={() => moveTo(widest.at)}>
            longest diameter
          </button>
          <span>{`${mm(widest.diameter)} at ${mm(widest.at, 1)}`}</span>
          {doubts.length > 0 && <small>{doubts.join(', ')}</small>}
        </div>
      )}
      {marks && marks.at === null && marks.references.length === 0 && (
        <NotSuggested reasons={profile.not_suggested} />
      )}
      <TurnButton />
    </section>
  );
}

/** Why no place is suggested. */
function NotSuggested({ reasons }: { readonly reasons: readonly string[] }) {
  return reasons.length > 0 ? (
    <p class="refused" data-testid="not-suggested">
      {reasons.map(told).join(' ')}
    </p>
  ) : null;
}

/** Turns the view about the place of the section. */
function TurnButton() {
  const turn = placeTurn.value;
  return (
    <button
      type="button"
      class="small"
      aria-pressed={turn !== null}
      title="The cut sweeps the diameters of the lumen, while the place stays where it is (o)"
      onClick={() => void togglePlaceTurn(engine)}
    >
      {`Turn about ${mm(turn?.at ?? store.pickedPlace.value, 1)}`}
    </button>
  );
}

function PlaceRow({ place, profile }: { readonly place: Place; readonly profile: Profile }) {
  const section = sectionNumbers(profile, place.at);
  const { diameter, uncertainty, shortest, longest, area: size, flags } = section;
  const doubts = doubtWords(section).join(', ');
  return (
    <div class="place-row" data-testid={`row-${place.kind}-${place.slot}`}>
      <button
        type="button"
        class="link"
        style={{ color: COLORS[place.kind] }}
        onClick={() => moveTo(place.at)}
        title="Show its section"
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
          aria-label={`Remove the ${placeName(place)}`}
          onClick={() => remove(place)}
        >
          ×
        </button>
      )}
    </div>
  );
}
