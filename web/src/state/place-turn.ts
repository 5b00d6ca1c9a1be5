/** Turning the view about a place on a vessel: the cut sweeps the diameters of its lumen, while the place stays where it is. */
import { batch, effect, signal, untracked } from '@preact/signals';
import type { Asked } from '../core/asked';
import { resized, turnedAbout } from '../core/camera';
import type { Camera, LineId, Vector } from '../core/messages';
import { length, subtract, turned } from '../core/vectors';
import { destination, flyTo } from './flight';
import * as store from './store';
import { tellFailure } from './telling';
import { tool } from './tool';

/** A turn that is under way. */
export interface PlaceTurn {
  readonly line: LineId;
  /** The place along the vessel (mm). */
  readonly at: number;
  /** The view at 0 degrees; its middle is the place, and what is up in it the axis. */
  readonly first: Camera;
  /** The diameter that is cut after each degree (mm), which repeat; none where a view has no two walls. */
  readonly diameters: readonly (number | null)[];
  /** How far the viewer has moved: whole degrees from -180 to 179. */
  readonly angle: number;
  /** The least and the largest diameter that was cut so far (mm). */
  readonly least: number | null;
  readonly largest: number | null;
}

export const placeTurn = signal<PlaceTurn | null>(null);

/** Axes that differ by less are those of one view. */
const SAME = 1e-6;

/** Begins a turn about the place of the section, or ends the one that is under way. */
export async function togglePlaceTurn(engine: Asked): Promise<void> {
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
    // The vessel may have been traced anew meanwhile, or another one picked.
    if (store.pickedLine() === line) {
      begin(engine, { line, at, first, diameters });
    }
  } catch (error) {
    tellFailure(error);
  }
}

function begin(engine: Asked, found: Pick<PlaceTurn, 'line' | 'at' | 'first' | 'diameters'>): void {
  const diameter = found.diameters[0] ?? null;
  batch(() => {
    store.isTurning.value = false;
    flyTo(engine, found.first);
    placeTurn.value = { ...found, angle: 0, least: diameter, largest: diameter };
  });
}

/** The view stays as it is. */
export function endPlaceTurn(): void {
  placeTurn.value = null;
}

/** The diameter that a turn cuts after some degrees (mm). */
export function diameterAfter({ diameters }: Pick<PlaceTurn, 'diameters'>, degrees: number): number | null {
  const count = diameters.length;
  return diameters[((degrees % count) + count) % count] ?? null;
}

/** A turn after it went on to an angle (degrees) by the shorter way, over all cuts between. */
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

/** Turns the view on to an angle (degrees). */
export function turnTo(angle: number): void {
  const [turn, camera] = [placeTurn.value, store.camera.value];
  const next = turn && sweptTo(turn, angle);
  if (!turn || !next || !camera || next.angle === turn.angle) {
    return;
  }
  // One who turns before the first view is reached does so from there.
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

/** Parts of degrees of a drag that is under way. */
let rest = 0;

/** The place follows a drag to the right as the surface of a ball does: the height of the view is half a turn. */
export function dragPlaceTurn(pixels: number, height: number): void {
  const turn = placeTurn.value;
  if (turn) {
    const wanted = rest - (180 * pixels) / Math.max(height, 1);
    const whole = Math.trunc(wanted);
    rest = wanted - whole;
    turnTo(turn.angle + whole);
  }
}

/** Ends a turn as soon as something else turns the view, takes up a tool, or shows another vessel. */
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

/** Whether a view is the one of a turn, moved and magnified at will. */
function isOf({ first, angle }: PlaceTurn, seen: Camera): boolean {
  const direction = turned(first.direction, first.up, radians(angle));
  return near(seen.direction, direction) && near(seen.up, first.up);
}

const near = (a: Vector, b: Vector): boolean => length(subtract(a, b)) < SAME;

/** An angle from -180 to 179 degrees. */
const withinCircle = (degrees: number): number => ((((degrees + 180) % 360) + 360) % 360) - 180;

const radians = (degrees: number): number => (degrees * Math.PI) / 180;
