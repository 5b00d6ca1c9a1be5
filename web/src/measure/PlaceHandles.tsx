/** Handles to drag the marked places, in the chart, the CPR and the turning view. */
import type { Pair, ReportPlace } from '../core/messages';
import { Handle } from '../pane/Handle';
import { isCrossed } from '../state/measuring';
import { currentPlaces, currentVessel } from './current';
import { beginMove, confirm, endMove, move, putBack, remove } from './editing';
import { pixelAt, valueAt } from './layout';
import type { Kind, VesselPlace } from './marks';
import { mm, placeName } from './words';

/** Colour of a place in a report. The engine gives the places their names. */
export const colorOfPlace = ({ is_reference: isReference, name }: ReportPlace): string =>
  COLORS[isReference ? 'reference' : name === 'noted diameter' ? 'diameter' : 'place'];

export const COLORS: Readonly<Record<Kind, string>> = {
  place: '#ff6b6b',
  reference: '#7ee787',
  stretch: '#ffb454',
  secondStretch: '#d2a8ff',
  diameter: '#79c0ff',
};

/** Movement per press of an arrow key (mm); with Shift ten times as far. */
const STEP = 0.5;

interface PlaceHandlesProps {
  readonly view: string;
  /** Pixel of a place at an arc length (mm); null if it is not visible. */
  pixelAt(at: number, place: VesselPlace): Pair | null;
  /** Arc length at a pixel (mm); `before` is the arc length before the move. */
  atOf(pixel: Pair, before: number): number;
}

/** The places in a stable order. A reference dragged past the stenosis keeps its key, so the drag continues. */
function grips(): { readonly key: string; readonly place: VesselPlace }[] {
  return currentPlaces.value
    .map((place) => {
      const isSwapped = place.kind === 'reference' && isCrossed.value;
      return { key: `${place.kind} ${isSwapped ? 1 - place.slot : place.slot}`, place };
    })
    .sort((a, b) => (a.key < b.key ? -1 : 1));
}

export function PlaceHandles({ view, pixelAt, atOf }: PlaceHandlesProps) {
  return (
    <>
      {grips().map(({ key, place }) => {
        const at = pixelAt(place.at, place);
        return (
          at && (
            <Handle
              key={key}
              at={at}
              words={`${placeName(place)}, ${mm(place.at, 1)}, ${view}`}
              color={COLORS[place.kind]}
              kind={`${place.kind} ${place.isSuggestion ? 'suggestion' : 'mark'}`}
              onBegin={() => beginMove(place)}
              onDrag={(pixel) => move(atOf(pixel, place.at))}
              onArrow={([right, down]) => move(place.at + STEP * (right + down))}
              onEnd={endMove}
              onPutBack={putBack}
              onRemove={() => remove(place)}
              {...(place.isSuggestion && { onConfirm: () => confirm(place) })}
            />
          )
        );
      })}
    </>
  );
}

const HANDLE_INSET_PX = 16;

/** Lines with handles at the marked places, over the straightened vessel when it is vertical. */
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
