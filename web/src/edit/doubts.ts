/** A walk through the doubtful branches: the view turns to each, and it is accepted or left out. */
import type { Asked } from '../core/asked';
import type { Camera, DocumentVessel, LineId } from '../core/messages';
import { placeCrossHair } from '../link/cross-hair';
import { doubtful, vesselOf } from '../state/changes';
import { flyToAnswer } from '../state/flight';
import { document_ } from '../state/history';
import { camera, started } from '../state/store';
import { tellFailure } from '../state/telling';
import { accept, leaveOut } from './branches';
import { contents } from './lines';
import { chosenDoubt } from './mode';

/** Why a vessel is doubtful, in a word or two where the engine has them. */
export function reasonOf({ doubt }: DocumentVessel): string {
  return started.value?.doubts.find(({ words }) => words === doubt)?.short ?? doubt ?? '';
}

/** How many vessels are doubtful, and for which reasons, the most frequent one first. */
export function countedDoubts(vessels: readonly DocumentVessel[]): string {
  const counts = new Map<string, number>();
  for (const reason of vessels.map(reasonOf)) {
    counts.set(reason, (counts.get(reason) ?? 0) + 1);
  }
  const counted = [...counts].sort(([, a], [, b]) => b - a).map(([reason, count]) => `${count} ${reason}`);
  return `${vessels.length} doubtful: ${counted.join(', ')}`;
}

/** The place of the doubtful branch that is chosen among them, from 0, and how many there are. */
export function placeOfDoubt(): readonly [number, number] {
  const all = doubtful(document_.value);
  return [all.findIndex((vessel) => vessel.id === chosenDoubt.value), all.length];
}

/** Chooses a doubtful branch, and turns the view to it. */
export async function showDoubt(engine: Asked, vessel: DocumentVessel): Promise<void> {
  chosenDoubt.value = vessel.id;
  const points = contents.value.get(vessel.line)?.points ?? [];
  const middle = points[Math.floor(points.length / 2)];
  try {
    if (middle) {
      placeCrossHair({ ...(await engine.ask('at', middle)), vessel: null, arc_length: null }, 'turning');
    }
    if (camera.value) {
      await flyToAnswer(engine, viewOf(engine, camera.value, vessel.line));
    }
  } catch (error) {
    tellFailure(error);
  }
}

/** Seen nearer, a short branch would stand alone: what lies around it tells what it is (mm along the shorter side). */
const LEAST_SEEN = 80;

/** The best view of a line, amid what lies around it. */
async function viewOf(engine: Asked, from: Camera, line: LineId): Promise<Camera> {
  const best = await engine.ask('best_view', { camera: from, line });
  return { ...best, pixel_spacing: Math.max(best.pixel_spacing, LEAST_SEEN / Math.min(...best.size)) };
}

/** Chooses the next doubtful branch, or the one before; the first one where none is chosen, and after the last. */
export function stepDoubt(engine: Asked, by: 1 | -1): void {
  const all = doubtful(document_.value);
  const [now] = placeOfDoubt();
  const next = all[now < 0 ? 0 : (now + by + all.length) % all.length];
  if (next) {
    void showDoubt(engine, next);
  }
}

/** Accepts the branch that is chosen, or leaves it out, and goes on with the one that follows. */
export async function answerDoubt(engine: Asked, answer: 'accept' | 'leave out'): Promise<void> {
  const chosen = vesselOf(document_.value, chosenDoubt.value);
  if (!chosen?.doubt) {
    return;
  }
  const all = doubtful(document_.value);
  const at = all.indexOf(chosen);
  const following = [...all.slice(at + 1), ...all.slice(0, at)][0];
  chosenDoubt.value = null;
  if ((await (answer === 'accept' ? accept : leaveOut)(engine, [chosen.id])) && following) {
    await showDoubt(engine, following);
  }
}
