/** The vessel that is being drawn: its clicks that are no vessel yet, and the way to the pointer. */
import { computed, effect, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Latest } from '../core/latest';
import type { PathRequest, Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { vesselOf } from '../state/changes';
import { document_ } from '../state/history';
import { nextColor } from '../state/palette';
import { active, tool } from '../state/tool';

/** The first point of a vessel that has no second one yet. */
export const first = signal<Vector | null>(null);
/** A place from a projection, which is looked at in the slices before it becomes a point. */
export const candidate = signal<Vector | null>(null);
/** Where the pointer is, in the world. */
export const target = signal<Vector | null>(null);
/** A point that is being traced, and which vessel it is of. */
interface Coming {
  readonly point: Vector;
  readonly drawing: number;
}
/** Points that are being traced, also of vessels that were ended meanwhile. */
export const coming = signal<readonly Coming[]>([]);
/** Which vessel is drawn: it is counted on when one ends, so that what comes later is of another one. */
export const drawing = signal(0);

/** A click of a vessel that is being dragged, and where it is now. */
export interface Dragged {
  readonly id: number;
  readonly number: number;
  readonly point: Vector;
}
export const dragged = signal<Dragged | null>(null);
/** A stopper that is being dragged, by its number. */
export const draggedStopper = signal<Omit<Dragged, 'id'> | null>(null);

/** A way that a vessel would take; where none was found it is straight. */
export interface LivePath {
  readonly points: readonly Vector[];
  readonly isFound: boolean;
}
export const livePaths = signal<readonly LivePath[]>([]);

/** The vessel that the next point belongs to; null where the next point begins one. */
export const drawn = computed(() => vesselOf(document_.value, active.value));

/** The colour of the vessel that is drawn, also before there is one. */
export const drawnColor = computed(() => drawn.value?.color ?? nextColor(document_.value.vessels));

/** The point from which the vessel goes on. */
export const anchor = computed<Vector | null>(
  () =>
    coming.value.findLast((one) => one.drawing === drawing.value)?.point ??
    drawn.value?.clicks?.at(-1) ??
    first.value,
);

/** Whether a vessel is being drawn. */
export const isDrawing = computed(() => anchor.value !== null);

/** Nearer than this the pointer is at the point itself (mm). */
const SAME = 0.05;

type Leg = readonly [from: Vector, to: Vector];

/** The ways that are to be shown: to the pointer, or from both neighbours to a click that is dragged. */
function legs(): readonly Leg[] {
  const moved = dragged.value;
  if (moved) {
    const clicks = vesselOf(document_.value, moved.id)?.clicks ?? [];
    const beside = [clicks[moved.number - 1], clicks[moved.number + 1]];
    return beside.filter((click) => click !== undefined).map((click) => [click, moved.point] as const);
  }
  const [from, to] = [anchor.value, candidate.value ?? target.value];
  return tool.value === 'trace' && from && to && length(subtract(to, from)) > SAME ? [[from, to]] : [];
}

/** The engine looks for so long at once, and goes on where it was when it is asked again: this often for a pointer that rests. */
const MOST_TRIES = 40;

/** Shows the live path from now on, always the latest; gives what ends it. */
export function followPointer(engine: Asked): () => void {
  const latest = new Latest();
  let number = 0;
  /** What was asked before this is of a vessel that is no longer drawn. */
  let ended = 0;
  return effect(() => {
    number += 1;
    const own = number;
    const wanted = legs();
    const { stoppers, bridge } = document_.value;
    const look = async (tries: number) => {
      const paths = await Promise.all(wanted.map((leg) => pathOf(engine, leg, { stoppers, bridge })));
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

async function pathOf(
  engine: Asked,
  [from, to]: Leg,
  rules: Pick<PathRequest, 'stoppers' | 'bridge'>,
): Promise<LivePath> {
  const points = await engine.ask('path', { from, to, ...rules }).catch(() => null);
  return points ? { points, isFound: true } : { points: [from, to], isFound: false };
}

/** Forgets what is drawn but the vessels of the document. */
export function forgetDrawing(): void {
  first.value = null;
  candidate.value = null;
  target.value = null;
  dragged.value = null;
  draggedStopper.value = null;
}
