/** Turns the view about a place on a vessel, so that the cut passes through all diameters there. */

import { batch, effect, signal, untracked } from '@preact/signals';
import { resized, turnedAbout } from '../core/camera';
import { GESTURES } from '../core/generated/tables';
import type { Camera, LineId, Vector } from '../core/messages';
import { length, subtract, turned } from '../core/vectors';
import { engine } from '../worker/engine';
import { destination, flyTo } from './flight';
import { showFailure } from './message';
import * as store from './store';
import { tool } from './tool';

export interface PlaceTurn {
  readonly line: LineId;
  /** Arc length of the place (mm). */
  readonly at: number;
  /** The view at 0°: centred on the place, with the axis of the vessel upwards. */
  readonly first: Camera;
  /** Diameter seen in the cut at each degree from 0 to 179 (mm); null if it shows fewer than two walls. */
  readonly diameters: readonly (number | null)[];
  /** Rotation of the viewer about the axis, in integer degrees from -180 to 179. */
  readonly angle: number;
  /** Smallest and largest diameter seen so far (mm). */
  readonly least: number | null;
  readonly largest: number | null;
}

export const placeTurn = signal<PlaceTurn | null>(null);

const AXIS_TOLERANCE = 1e-6;

export async function togglePlaceTurn(): Promise<void> {
  const [vessel, line, camera] = [store.pickedVessel.value, store.pickedLine(), store.camera.value];
  if (placeTurn.value) {
    endPlaceTurn();
    return;
  }
  if (vessel === null || line === null || !camera || !store.hasVolume.value) {
    return;
  }
  const at = store.pickedPlace.value;
  try {
    const { camera: first, diameters } = await engine.ask('turn_about', { vessel, at, size: camera.size });
    // Meanwhile the vessel may have been retraced, or another one picked.
    if (store.pickedLine() === line) {
      begin({ line, at, first, diameters });
    }
  } catch (error) {
    showFailure(error);
  }
}

function begin(found: Pick<PlaceTurn, 'line' | 'at' | 'first' | 'diameters'>): void {
  const diameter = found.diameters[0] ?? null;
  batch(() => {
    store.isTurning.value = false;
    flyTo(found.first);
    placeTurn.value = { ...found, angle: 0, least: diameter, largest: diameter };
  });
}

export function endPlaceTurn(): void {
  placeTurn.value = null;
}

/** Diameter seen in the cut at an angle (mm). */
export function diameterAfter({ diameters }: Pick<PlaceTurn, 'diameters'>, degrees: number): number | null {
  const count = diameters.length;
  return diameters[((degrees % count) + count) % count] ?? null;
}

/** Rotates to an angle (degrees) in the shorter direction; the diameters of all cuts on the way count as seen. */
export function sweptTo(turn: PlaceTurn, angle: number): PlaceTurn {
  const by = withinCircle(Math.round(angle) - turn.angle);
  const cut = Array.from({ length: Math.abs(by) }, (_, n) =>
    diameterAfter(turn, turn.angle + Math.sign(by) * (n + 1)),
  );
  const seen = [...cut, turn.least, turn.largest].filter((diameter) => diameter !== null);
  return {
    ...turn,
    angle: withinCircle(turn.angle + by),
    least: seen.length > 0 ? Math.min(...seen) : null,
    largest: seen.length > 0 ? Math.max(...seen) : null,
  };
}

export function turnTo(angle: number): void {
  const [turn, camera] = [placeTurn.value, store.camera.value];
  const next = turn && sweptTo(turn, angle);
  if (!turn || !next || !camera || next.angle === turn.angle) {
    return;
  }
  // During the flight to the first view, turning starts from the end of this flight.
  const seen = resized(destination.value ?? camera, camera.size);
  batch(() => {
    destination.value = null;
    placeTurn.value = next;
    store.camera.value = turnedAbout(
      seen,
      turn.first.center,
      turn.first.up,
      radians(next.angle - turn.angle),
    );
  });
}

const DEGREES_PER_HEIGHT = (GESTURES.turn_per_height * 180) / Math.PI;

/** Fraction of a degree that remains after a step of a drag. */
let rest = 0;

/** A drag to the right rotates the view like a trackball; a drag as long as the view is high rotates it by 180°. */
export function dragPlaceTurn(pixels: number, height: number): void {
  const turn = placeTurn.value;
  if (turn) {
    const wanted = rest - (DEGREES_PER_HEIGHT * pixels) / Math.max(height, 1);
    const whole = Math.trunc(wanted);
    rest = wanted - whole;
    turnTo(turn.angle + whole);
  }
}

/** Ends turning when the view, the tool or the vessel changes. */
export function followPlaceTurn(): () => void {
  return effect(() => {
    const turn = placeTurn.value;
    const seen = destination.value ?? store.camera.value;
    const isOn = tool.value !== 'trace' && tool.value !== 'stopper' && store.pickedLine() === turn?.line;
    if (turn && !(isOn && seen && isOf(turn, seen))) {
      untracked(endPlaceTurn);
    }
  });
}

/** Whether a camera has the direction of the turn; pan and zoom do not matter. */
function isOf({ first, angle }: PlaceTurn, seen: Camera): boolean {
  const direction = turned(first.direction, first.up, radians(angle));
  return near(seen.direction, direction) && near(seen.up, first.up);
}

const near = (a: Vector, b: Vector): boolean => length(subtract(a, b)) < AXIS_TOLERANCE;

/** The same angle in the range from -180 to 179 degrees. */
const withinCircle = (degrees: number): number => ((((degrees + 180) % 360) + 360) % 360) - 180;

const radians = (degrees: number): number => (degrees * Math.PI) / 180;
