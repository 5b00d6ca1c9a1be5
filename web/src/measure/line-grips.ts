/** A drag that begins near the line of a place moves the place. A click there still reaches the picture. */
import { useRef } from 'preact/hooks';
import type { Axis } from '../core/messages';
import { currentPlaces } from './current';
import { beginMove, endMove, move, putBack } from './editing';
import { pixelAt, valueAt } from './layout';
import type { VesselPlace } from './marks';

export const GRAB_DISTANCE_PX = 22;
const CLICK_MOVE_PX = 4;

export function nearestLine(places: readonly VesselPlace[], x: Axis, column: number): VesselPlace | null {
  const distance = (place: VesselPlace) => Math.abs(pixelAt(x, place.at) - column);
  const [nearest] = [...places].sort((a, b) => distance(a) - distance(b));
  return nearest && distance(nearest) <= GRAB_DISTANCE_PX ? nearest : null;
}

interface Grip {
  readonly place: VesselPlace;
  /** Column of the pointer when the drag began, and its distance from the line. */
  readonly from: number;
  readonly beside: number;
  isMoving: boolean;
}

/** Event handlers for the capture phase of the pane. `x` is null before the vessel is shown. */
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
      if (!held.isMoving && Math.abs(column - held.from) > CLICK_MOVE_PX) {
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
