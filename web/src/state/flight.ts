/** Views that are asked for by name do not jump: the camera flies there, so that the eye keeps hold of the vessels. */
import { signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { resized } from '../core/camera';
import type { Camera } from '../core/messages';
import * as store from './store';
import { tellFailure } from './telling';

/** How long a flight takes (ms). */
const FLIGHT = 400;

/** How many views the engine is asked for: one for each picture of a screen that shows 120 in a second. */
const VIEWS = 49;

/** Where a flight that is under way leads. */
export const destination = signal<Camera | null>(null);

let flights = 0;

/** Flies to a view. A change of the camera meanwhile ends the flight where it is; one of the pane's size does not. */
export function flyTo(engine: Asked, to: Camera): void {
  flights += 1;
  const from = store.camera.value;
  // A view that turns already, or a reader who wants no motion: at once.
  if (!from || store.isTurning.value || window.matchMedia('(prefers-reduced-motion: reduce)').matches) {
    destination.value = null;
    store.camera.value = from ? resized(to, from.size) : to;
    return;
  }
  destination.value = to;
  void fly(engine, flights, from, to);
}

/** Asks the engine for the views between, and shows them. */
async function fly(engine: Asked, number: number, from: Camera, to: Camera): Promise<void> {
  try {
    const views = await engine.ask('flight', { from: resized(from, to.size), to, views: VIEWS });
    show(number, from, [...views.slice(0, -1), to]);
  } catch (error) {
    if (number === flights) {
      destination.value = null;
    }
    tellFailure(error);
  }
}

/** Shows the views of a flight, each at its time, as long as nothing else changes the one that was shown last. */
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

/** Whether both are one view, in panes of whatever size. */
const looksAlike = (a: Camera, b: Camera): boolean =>
  a.center === b.center && a.direction === b.direction && a.up === b.up;

/** Flies to a view as soon as the engine has told it, or says why there is none. */
export async function flyToAnswer(engine: Asked, view: Promise<Camera>): Promise<void> {
  try {
    flyTo(engine, await view);
  } catch (error) {
    tellFailure(error);
  }
}
