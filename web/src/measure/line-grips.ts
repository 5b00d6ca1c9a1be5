/** Drags that begin near a place line move the place; clicks there go to the picture below. */
import { useRef } from 'preact/hooks';
import { currentPlaces } from './current';
import { beginMove, endMove, move, putBack } from './editing';
import type { Place } from './marks';
import { type Axis, pixelAt, valueAt } from './scale';

/** Largest distance from a line at which a drag may begin (CSS pixels). */
export const HIT = 22;
/** Movement up to this is a click (CSS pixels). */
const STILL = 4;

export function nearestLine(places: readonly Place[], x: Axis, column: number): Place | null {
  const away = (place: Place) => Math.abs(pixelAt(x, place.at) - column);
  const [nearest] = [...places].sort((a, b) => away(a) - away(b));
  return nearest && away(nearest) <= HIT ? nearest : null;
}

interface Grip {
  readonly place: Place;
  /** Column of the pointer at the start, and of the line. */
  readonly from: number;
  readonly beside: number;
  isMoving: boolean;
}

/** Handlers in the capture phase of the pane; none before the vessel has an axis. */
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
