/** The cross-hair, which all views share: where it is put in one, it moves in all. */
import { batch } from '@preact/signals';
import type { Pick } from '../core/messages';
import { crossHair, pickedPlace, pickedVessel, type ViewName } from '../state/store';

/** Puts the cross-hair where a view was pointed at; a vessel there becomes the one of CPR and section. */
export function placeCrossHair(pick: Pick, from: ViewName): void {
  batch(() => {
    crossHair.value = {
      point: pick.point,
      value: pick.value,
      vessel: pick.vessel,
      arcLength: pick.arc_length,
    };
    // A section stays where it is while one points into it.
    if (pick.vessel !== null && from !== 'section') {
      pickedVessel.value = pick.vessel;
      pickedPlace.value = pick.arc_length ?? pickedPlace.value;
    }
  });
}
