/** Review of the doubtful branches: shows one after another, and the user accepts it or leaves it out. */

import type { Camera, DocumentVessel, LineId } from '../core/messages';
import { doubtful, vesselOf } from '../state/changes';
import { placeAnswer } from '../state/cross-hair';
import { flyToAnswer } from '../state/flight';
import { document_ } from '../state/history';
import { contents } from '../state/lines';
import { showFailure } from '../state/message';
import { camera, started } from '../state/store';
import { chooseDoubt, chosenDoubt } from '../state/tool';
import { engine } from '../worker/engine';
import { accept, leaveOut } from './branches';

/** Why the vessel is doubtful, in short if the engine has a short form. */
export function reasonOf({ doubt }: DocumentVessel): string {
  return started.value?.doubts.find(({ words }) => words === doubt)?.short ?? doubt ?? '';
}

/** Number of doubtful vessels with their reasons, most frequent first. */
export function countedDoubts(vessels: readonly DocumentVessel[]): string {
  const counts = new Map<string, number>();
  for (const reason of vessels.map(reasonOf)) {
    counts.set(reason, (counts.get(reason) ?? 0) + 1);
  }
  const counted = [...counts].sort(([, a], [, b]) => b - a).map(([reason, count]) => `${count} ${reason}`);
  return `${vessels.length} doubtful: ${counted.join(', ')}`;
}

export function placeOfDoubt(): readonly [number, number] {
  const all = doubtful(document_.value);
  return [all.findIndex((vessel) => vessel.id === chosenDoubt.value), all.length];
}

export async function showDoubt(vessel: DocumentVessel): Promise<void> {
  chooseDoubt(vessel.id);
  const points = contents.value.get(vessel.line)?.points ?? [];
  const middle = points[Math.floor(points.length / 2)];
  try {
    if (middle) {
      const pick = engine.ask('at', middle);
      await placeAnswer(
        pick.then((found) => ({ ...found, vessel: null, arc_length: null })),
        'turning',
      );
    }
    if (camera.value) {
      await flyToAnswer(viewOf(camera.value, vessel.line));
    }
  } catch (error) {
    showFailure(error);
  }
}

/** Smallest field of view (mm, shorter side); the surroundings help to identify the branch. */
const LEAST_SEEN = 80;

async function viewOf(from: Camera, line: LineId): Promise<Camera> {
  const best = await engine.ask('best_view', { camera: from, line });
  return { ...best, pixel_spacing: Math.max(best.pixel_spacing, LEAST_SEEN / Math.min(...best.size)) };
}

/** Shows the next or previous doubtful branch; after the last comes the first. */
export function stepDoubt(by: 1 | -1): void {
  const all = doubtful(document_.value);
  const [now] = placeOfDoubt();
  const next = all[now < 0 ? 0 : (now + by + all.length) % all.length];
  if (next) {
    void showDoubt(next);
  }
}

export async function answerDoubt(answer: 'accept' | 'leave out'): Promise<void> {
  const chosen = vesselOf(document_.value, chosenDoubt.value);
  if (!chosen?.doubt) {
    return;
  }
  const all = doubtful(document_.value);
  const at = all.indexOf(chosen);
  const following = [...all.slice(at + 1), ...all.slice(0, at)][0];
  chooseDoubt(null);
  if ((await (answer === 'accept' ? accept : leaveOut)([chosen.id])) && following) {
    await showDoubt(following);
  }
}
