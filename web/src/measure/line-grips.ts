/** The whole line of a place is its grip: a drag that begins near it moves the place, a click there is one of the picture beneath. */
import { useRef } from 'preact/hooks';
import { currentPlaces } from './current';
import { beginMove, endMove, move, putBack } from './editing';
import type { Place } from './marks';
import { type Axis, pixelAt, valueAt } from './scale';

/** How near to a line a drag may begin (CSS pixels). */
export const HIT = 22;
/** A press that moves no farther is a click (CSS pixels). */
const STILL = 4;

/** The place whose line is nearest to a column, if any is near enough. */
export function nearestLine(places: readonly Place[], x: Axis, column: number): Place | null {
  const away = (place: Place) => Math.abs(pixelAt(x, place.at) - column);
  const [nearest] = [...places].sort((a, b) => away(a) - away(b));
  return nearest && away(nearest) <= HIT ? nearest : null;
}

interface Grip {
  readonly place: Place;
  /** The column where the pointer went down, and that of the line beside it. */
  readonly from: number;
  readonly beside: number;
  isMoving: boolean;
}

/** What the pane of a lying vessel hears before its pictures do; nothing where the vessel has no axis yet. */
export function useLineGrips(x: Axis | null) {
  const grip = useRef<Grip | null>(null);
  const columnOf = (event: PointerEvent) =>
    event.clientX - (event.currentTarget as HTMLElement).getBoundingClientRect().left;
  const near = (event: PointerEvent) =>
    x && !(event.target as Element).closest('button, input, select')
      ? nearestLine(currentPlaces.value, x, columnOf(event))
      : null;
  const end = () => {
    if (grip.current?.isMoving) {
      endMove();
    }
    grip.current = null;
  };
  return {
    onPointerDownCapture: (event: PointerEvent) => {
      const place = event.button === 0 ? near(event) : null;
      const from = columnOf(event);
      grip.current = place && x && { place, from, beside: pixelAt(x, place.at) - from, isMoving: false };
    },
    onPointerMoveCapture: (event: PointerEvent) => {
      const held = grip.current;
      if (!held || !x) {
        (event.currentTarget as HTMLElement).classList.toggle('near-line', near(event) !== null);
        return;
      }
      const column = columnOf(event);
      if (!held.isMoving && Math.abs(column - held.from) > STILL) {
        held.isMoving = true;
        beginMove(held.place);
      }
      if (held.isMoving) {
        event.stopPropagation();
        move(valueAt(x, column + held.beside));
      }
    },
    onPointerUpCapture: end,
    onPointerCancelCapture: end,
    onKeyDownCapture: (event: KeyboardEvent) => {
      if (event.key === 'Escape' && grip.current?.isMoving) {
        event.stopPropagation();
        grip.current = null;
        putBack();
      }
    },
  };
}
