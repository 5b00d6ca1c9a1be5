/** Lines with handles at the marked places, over the straightened vessel when it is vertical. */
import type { Pair } from '../core/messages';
import { currentPlaces, currentVessel } from './current';
import { pixelAt, valueAt } from './layout';
import { COLORS, PlaceHandles } from './PlaceHandles';

const HANDLE_INSET_PX = 16;

export function UprightPlaces({ size, spacing }: { readonly size: Pair; readonly spacing: number }) {
  const length = currentVessel.value?.length ?? 0;
  if (length === 0) {
    return null;
  }
  const y = { low: 0, high: length, start: 0, end: length / spacing };
  return (
    <>
      <svg class="place-lines" width={size[0]} height={size[1]} aria-hidden="true">
        {currentPlaces.value.map((place) => (
          <path
            key={`${place.kind} ${place.slot}`}
            d={`M0 ${pixelAt(y, place.at)}H${size[0]}`}
            stroke={COLORS[place.kind]}
            stroke-dasharray={place.isSuggestion ? '4 4' : undefined}
          />
        ))}
      </svg>
      <PlaceHandles
        view="in the CPR"
        pixelAt={(at) => [size[0] - HANDLE_INSET_PX, pixelAt(y, at)]}
        atOf={([, row]) => valueAt(y, row)}
      />
    </>
  );
}
