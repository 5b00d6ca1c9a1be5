/** Previews while tracing: the path to the pointer, and the whole vessel at a single clicked point. */
import { effect } from '@preact/signals';
import { Latest } from '../core/latest';
import type { PathRequest, Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { vesselOf } from '../state/changes';
import {
  anchor,
  candidate,
  checked,
  dragged,
  forgetWhole,
  type LivePath,
  only,
  showPaths,
  showWhole,
  target,
} from '../state/drawing';
import { document_ } from '../state/history';
import { tool } from '../state/tool';
import { engine } from '../worker/engine';

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
        showPaths(paths);
      }
      if (own === number && tries < MOST_TRIES && paths.some((path) => !path.isFound)) {
        latest.run(() => look(tries + 1));
      }
    };
    if (wanted.length === 0) {
      ended = number;
      showPaths([]);
    }
    latest.run(() => look(1));
  });
}

async function pathOf([from, to]: Leg, rules: Pick<PathRequest, 'stoppers' | 'bridge'>): Promise<LivePath> {
  const points = await engine.ask('path', { from, to, ...rules }).catch(() => null);
  return points ? { points, isFound: true } : { points: [from, to], isFound: false };
}

/** Keeps the preview of the whole vessel up to date. Returns a function that stops this. */
export function followWhole(): () => void {
  const latest = new Latest();
  return effect(() => {
    const click = only.value;
    const { vessels } = document_.value;
    const isChecked = click !== null && click === checked.peek();
    forgetWhole();
    if (click && !isChecked) {
      latest.run(async () => {
        const found = await engine.ask('whole_vessel', { click, vessels }).catch(() => null);
        showWhole(found, click);
      });
    }
  });
}
