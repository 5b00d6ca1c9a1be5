/** The cross-hair, shared by all views, and the section, which moves along the picked vessel. */

import { batch } from '@preact/signals';
import { Latest } from '../core/latest';
import type { Pick, Vector } from '../core/messages';
import { engine } from '../worker/engine';
import { recover } from './device';
import { crossHair, pickedPlace, pickedVessel, putCrossHair, report, type ViewName } from './store';

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

const moving = new Latest();
/** Numbers of movements that answers to earlier requests must not undo: all, and those to a place off the vessel. */
let moves = 0;
let jumps = 0;

/** Moves the cross-hair at once; its value is not known yet. */
export function jumpTo(point: Vector): void {
  moves += 1;
  jumps += 1;
  putCrossHair(point);
}

/**
 * Moves the cross-hair at once, so that a later movement is never undone by a late answer; the value there is requested
 * afterwards.
 */
export function moveCrossHair(point: Vector, from: ViewName): void {
  jumpTo(point);
  moving.run(async () => {
    const pick = await engine.ask('at', point);
    if (crossHair.value?.point === point) {
      placeCrossHair(pick, from);
    }
  });
}

/** Places the cross-hair once the engine has answered, unless it has been moved meanwhile; null places nothing. */
export async function placeAnswer(answer: Promise<Pick | null>, from: ViewName): Promise<void> {
  const before = moves;
  const pick = await answer;
  if (pick && before === moves) {
    placeCrossHair(pick, from);
  }
}

export async function lookAt(point: Vector): Promise<void> {
  try {
    await placeAnswer(engine.ask('at', point), 'turning');
  } catch (error) {
    recover(error);
  }
}

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
  const before = jumps;
  moves += 1;
  latest.run(async () => {
    try {
      const [center] = await engine.ask('across', { vessel, at: at });
      const pick = { ...(await engine.ask('at', center)), vessel, arc_length: at };
      if (report.value?.volume === study && before === jumps) {
        placeCrossHair(pick, 'section');
      }
    } catch (error) {
      recover(error);
    }
  });
}

export const moveAlong = (by: number): void => moveTo(pickedPlace.value + by);
