/** The vessel being drawn: its first clicks, and the preview of the path to the pointer. */

import { computed, effect, signal } from '@preact/signals';
import { Latest } from '../core/latest';
import type { PathRequest, Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { vesselOf } from '../state/changes';
import { document_ } from '../state/history';
import { nextColor } from '../state/palette';
import { active, tool } from '../state/tool';
import { engine } from '../worker/engine';

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

/** Within this distance (mm), the pointer counts as being on the point. */
const SAME_POINT_MM = 0.05;

type Leg = readonly [from: Vector, to: Vector];

/** Previews to compute: one to the pointer, or two from the neighbours of a dragged click. */
function legs(): readonly Leg[] {
  const moved = dragged.value;
  if (moved) {
    const clicks = vesselOf(document_.value, moved.id)?.clicks ?? [];
    const beside = [clicks[moved.number - 1], clicks[moved.number + 1]];
    return beside.filter((click) => click !== undefined).map((click) => [click, moved.point] as const);
  }
  const [from, to] = [anchor.value, candidate.value ?? target.value];
  return tool.value === 'trace' && from && to && length(subtract(to, from)) > SAME_POINT_MM
    ? [[from, to]]
    : [];
}

/** Most requests for a resting pointer. Each one searches for a limited time; the next one continues the search. */
const MOST_TRIES = 40;

/** Keeps the path preview up to date. Returns a function that stops this. */
export function followPointer(): () => void {
  const latest = new Latest();
  let number = 0;
  /** Requests with a lower number belong to a vessel that is no longer drawn. */
  let ended = 0;
  return effect(() => {
    number += 1;
    const own = number;
    const wanted = legs();
    const { stoppers, bridge } = document_.value;
    const look = async (tries: number) => {
      const paths = await Promise.all(wanted.map((leg) => pathOf(leg, { stoppers, bridge })));
      if (own >= ended) {
        livePaths.value = paths;
      }
      if (own === number && tries < MOST_TRIES && paths.some((path) => !path.isFound)) {
        latest.run(() => look(tries + 1));
      }
    };
    if (wanted.length === 0) {
      ended = number;
      livePaths.value = [];
    }
    latest.run(() => look(1));
  });
}

async function pathOf([from, to]: Leg, rules: Pick<PathRequest, 'stoppers' | 'bridge'>): Promise<LivePath> {
  const points = await engine.ask('path', { from, to, ...rules }).catch(() => null);
  return points ? { points, isFound: true } : { points: [from, to], isFound: false };
}

export function forgetDrawing(): void {
  first.value = null;
  candidate.value = null;
  target.value = null;
  dragged.value = null;
  draggedStopper.value = null;
}
