/** Flights: animated changes of the camera, so that the user can follow how the view turns. */

import { signal } from '@preact/signals';
import { resized } from '../core/camera';
import type { Camera } from '../core/messages';
import { engine } from '../worker/engine';
import { showFailure } from './message';
import * as store from './store';

/** Duration of a flight (ms). */
const FLIGHT = 400;

/** Number of views of a flight: one per frame at 120 Hz. */
const VIEWS = 49;

/** The camera at the end of the current flight; null without a flight. */
export const destination = signal<Camera | null>(null);

let flights = 0;

/** Flies to a view. Another camera change ends the flight; a change of pane size does not. */
export function flyTo(to: Camera): void {
  flights += 1;
  const from = store.camera.value;
  // Without animation if the view is rotating, or if the user prefers reduced motion.
  if (!from || store.isTurning.value || window.matchMedia('(prefers-reduced-motion: reduce)').matches) {
    destination.value = null;
    store.camera.value = from ? resized(to, from.size) : to;
    return;
  }
  destination.value = to;
  void fly(flights, from, to);
}

async function fly(number: number, from: Camera, to: Camera): Promise<void> {
  try {
    const views = await engine.ask('flight', { from: resized(from, to.size), to, views: VIEWS });
    show(number, from, [...views.slice(0, -1), to]);
  } catch (error) {
    if (number === flights) {
      destination.value = null;
    }
    showFailure(error);
  }
}

/** Shows each view at its time, until something else changes the camera. */
function show(number: number, from: Camera, views: readonly Camera[]): void {
  const begun = performance.now();
  let last = from;
  const step = (now: number) => {
    if (number !== flights) {
      return;
    }
    const camera = store.camera.value;
    const share = Math.min(Math.max((now - begun) / FLIGHT, 0), 1);
    const view = views[Math.round(share * (views.length - 1))];
    if (!view || !camera || !looksAlike(camera, last)) {
      destination.value = null;
      return;
    }
    last = resized(view, camera.size);
    store.camera.value = last;
    if (share < 1) {
      requestAnimationFrame(step);
    } else {
      destination.value = null;
    }
  };
  requestAnimationFrame(step);
}

/** Whether two cameras show the same view, regardless of the pane size. */
const looksAlike = (a: Camera, b: Camera): boolean =>
  a.center === b.center && a.direction === b.direction && a.up === b.up;

export async function flyToAnswer(view: Promise<Camera>): Promise<void> {
  try {
    flyTo(await view);
  } catch (error) {
    showFailure(error);
  }
}
