/** The marked and suggested places of a vessel with their numbers, and the widest place. */
import type { Profile } from '../core/messages';
import { moveTo } from '../link/along';
import { currentPlaces } from './current';
import { confirm, remove } from './editing';
import { meanings } from './flags';
import type { Place } from './marks';
import { COLORS } from './PlaceHandles';
import { sectionNumbers } from './sections';
import { area, mm, NOTHING, placeName, spread } from './words';

export function PlacesTable({ profile }: { readonly profile: Profile }) {
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
      {!profile.counts.some(Boolean) && <p>No section counts: see the flags.</p>}
    </section>
  );
}

function PlaceRow({ place, profile }: { readonly place: Place; readonly profile: Profile }) {
  const { diameter, uncertainty, shortest, longest, area: size, flags } = sectionNumbers(profile, place.at);
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
        {`${shortest?.toFixed(2) ?? NOTHING} to ${mm(longest)}, ${area(size)}${flags.length > 0 ? ` · ${flags.join(', ')}` : ''}`}
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
