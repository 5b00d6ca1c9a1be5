/** The places of the picked vessel as handles over a picture: the same in the profile, the CPR and the turning view. */
import type { Pair, ReportPlace } from '../core/messages';
import { Handle } from '../pane/Handle';
import { currentPlaces } from './current';
import { beginMove, confirm, endMove, isCrossed, move, putBack, remove } from './editing';
import type { Kind, Place } from './marks';
import { mm, placeName } from './words';

/** The colour of a place of a report, whose names are the engine's. */
export const colorOfPlace = ({ is_reference: isReference, name }: ReportPlace): string =>
  COLORS[isReference ? 'reference' : name === 'noted diameter' ? 'diameter' : 'place'];

/** By what they mark; on the dark ground of pictures. */
export const COLORS: Readonly<Record<Kind, string>> = {
  place: '#ff6b6b',
  reference: '#7ee787',
  stretch: '#ffb454',
  secondStretch: '#d2a8ff',
  diameter: '#79c0ff',
};

/** The way of one arrow key along the vessel (mm); ten times as far with Shift. */
const STEP = 0.5;

interface PlaceHandlesProps {
  /** Where they are, such as `in the profile`. */
  readonly view: string;
  /** Where a place is seen; none where it is not. */
  pixelAt(at: number, place: Place): Pair | null;
  /** The arc length at a pixel; `before` is where the place was. */
  atOf(pixel: Pair, before: number): number;
}

/** A grip for each place; a reference that passes the stenosis keeps its grip, and grips keep their order, so that none is let go. */
function grips(): { readonly key: string; readonly place: Place }[] {
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
