/** Moves the cross-hair in all views. */

import type { Vector } from '../core/messages';
import { placeCrossHair } from '../state/cross-hair';
import { recover } from '../state/device';
import { engine } from '../worker/engine';

export async function lookAt(point: Vector): Promise<void> {
  try {
    placeCrossHair(await engine.ask('at', point), 'turning');
  } catch (error) {
    recover(error);
  }
}
