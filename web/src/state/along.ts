/** Moves the section along the picked vessel, in all views. */

import { Latest } from '../core/latest';
import { engine } from '../worker/engine';
import { placeCrossHair } from './cross-hair';
import { recover } from './device';
import { pickedPlace, pickedVessel, report } from './store';

const latest = new Latest();

export function moveTo(place: number): void {
  const vessel = pickedVessel.value;
  const length = vessel === null ? 0 : (report.value?.vessels?.[vessel]?.length ?? 0);
  const at = Math.min(Math.max(place, 0), length);
  pickedPlace.value = at;
  if (vessel === null) {
    return;
  }
  const study = report.value?.volume;
  latest.run(async () => {
    try {
      const [center] = await engine.ask('across', { vessel, at: at });
      const pick = { ...(await engine.ask('at', center)), vessel, arc_length: at };
      if (report.value?.volume === study) {
        placeCrossHair(pick, 'section');
      }
    } catch (error) {
      recover(error);
    }
  });
}

export const moveAlong = (by: number): void => moveTo(pickedPlace.value + by);
