/** Moves the cross-hair in all views. */

import { engine } from '../client/shared';
import type { Vector } from '../core/messages';
import { placeCrossHair } from '../link/cross-hair';
import { recover } from '../state/device';

export async function lookAt(point: Vector): Promise<void> {
  try {
    placeCrossHair(await engine.ask('at', point), 'turning');
  } catch (error) {
    recover(error);
  }
}
