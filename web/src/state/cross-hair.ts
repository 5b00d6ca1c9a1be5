/** The cross-hair, shared by all views. */
import { batch } from '@preact/signals';
import type { Pick } from '../core/messages';
import { crossHair, pickedPlace, pickedVessel, type ViewName } from './store';

/** Places the cross-hair. If a vessel lies at that point, it is picked. */
export function placeCrossHair(pick: Pick, from: ViewName): void {
  batch(() => {
    crossHair.value = {
      point: pick.point,
      value: pick.value,
      vessel: pick.vessel,
      arcLength: pick.arc_length,
    };
    if (pick.vessel !== null && from !== 'section') {
      pickedVessel.value = pick.vessel;
      pickedPlace.value = pick.arc_length ?? pickedPlace.value;
    }
  });
}
