/** The vessel being drawn: its points so far, the points at the pointer, and the previews. */

import { batch, computed, signal } from '@preact/signals';
import type { Edited, LineId, Told, Vector, WholeVessel } from '../core/messages';
import { nextColor, vesselOf } from './changes';
import { document_ } from './history';
import { active, tool } from './tool';

/** The first point of a vessel that has no second point yet. */
export const first = signal<Vector | null>(null);
/** A point from a projection that the user must confirm in the slices. */
export const candidate = signal<Vector | null>(null);
export const target = signal<Vector | null>(null);
interface Coming {
  readonly point: Vector;
  readonly drawing: number;
}
/** Clicked points that are still being traced, also those of vessels already ended. */
export const coming = signal<readonly Coming[]>([]);
/** Number of the vessel being drawn; late results of earlier ones are ignored. */
export const drawing = signal(0);

export interface Dragged {
  readonly id: number;
  readonly number: number;
  readonly point: Vector;
}
export const dragged = signal<Dragged | null>(null);
export const draggedStopper = signal<Omit<Dragged, 'id'> | null>(null);

/** A preview of the traced path; a straight line if none was found. */
export interface LivePath {
  readonly points: readonly Vector[];
  readonly isFound: boolean;
}
export const livePaths = signal<readonly LivePath[]>([]);

/** The vessel that the next point extends; null if it begins a new one. */
export const drawn = computed(() => vesselOf(document_.value, active.value));

export const drawnColor = computed(() => drawn.value?.color ?? nextColor(document_.value.vessels));

export const anchor = computed<Vector | null>(
  () =>
    coming.value.findLast((one) => one.drawing === drawing.value)?.point ??
    drawn.value?.clicks?.at(-1) ??
    first.value,
);

export const isDrawing = computed(() => anchor.value !== null);

/** The clicked point if the vessel has no other; the whole vessel there can be traced. */
export const only = computed<Vector | null>(() =>
  tool.value === 'trace' && !drawn.value && coming.value.length === 0
    ? (candidate.value ?? first.value)
    : null,
);

export const whole = signal<WholeVessel | null>(null);

/** A first point whose check has already returned the whole vessel. */
export const checked = signal<Vector | null>(null);

export function setFirst(point: Vector | null): void {
  first.value = point;
}

export function setCheckedFirst(point: Vector): void {
  batch(() => {
    checked.value = point;
    first.value = point;
  });
}

export function propose(point: Vector | null): void {
  candidate.value = point;
}

export function aimAt(point: Vector | null): void {
  target.value = point;
}

export function addComing(point: Vector): () => void {
  const own = { point, drawing: drawing.value };
  coming.value = [...coming.value, own];
  return () => {
    coming.value = coming.value.filter((one) => one !== own);
  };
}

export function dragClick(to: Dragged | null): void {
  dragged.value = to;
}

export function dragStopper(to: Omit<Dragged, 'id'> | null): void {
  draggedStopper.value = to;
}

export function showPaths(paths: readonly LivePath[]): void {
  livePaths.value = paths;
}

export function showWhole(found: WholeVessel | null, at: Vector): void {
  whole.value = only.value === at ? found : whole.value;
}

export function forgetWhole(): void {
  checked.value = null;
  whole.value = null;
}

export function extendBegun(id: number): void {
  batch(() => {
    active.value = id;
    first.value = null;
  });
}

export function endDrawing(): void {
  batch(() => {
    drawing.value += 1;
    active.value = null;
    forgetDrawing();
  });
}

function forgetDrawing(): void {
  first.value = null;
  candidate.value = null;
  target.value = null;
  dragged.value = null;
  draggedStopper.value = null;
}

/** What the engine told about the vessel that was traced last. */
const last = signal<{ readonly told: Told; readonly line: LineId | undefined } | null>(null);

/** The summary of the last trace; null if nothing was traced or the vessel has changed since. */
export const tracedSummary = computed<Told | null>(() => {
  const of = last.value;
  const vessel = vesselOf(document_.value, of?.told.vessel ?? null);
  return of && vessel?.line === of.line ? of.told : null;
});

export function storeSummary({ told, document }: Edited): void {
  const line = document.vessels.find((vessel) => vessel.id === told?.vessel)?.line;
  last.value = told && { told, line };
}
