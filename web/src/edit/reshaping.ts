/** Moves and smooths the line of a vessel by hand, with a preview. */
import { Latest } from '../core/latest';
import type { LineId, Vector } from '../core/messages';
import { nameOf, vesselOf } from '../state/changes';
import { recover } from '../state/device';
import { document_ } from '../state/history';
import { showMessage } from '../state/message';
import { showReshaped } from '../state/reshaping';
import { engine } from '../worker/engine';
import { commit } from './committing';

/** A move of the line from an arc length (mm) to a place, or a smoothing (standard deviation, mm). */
type Change =
  | { readonly kind: 'bend'; readonly at: number; readonly to: Vector }
  | { readonly kind: 'smooth'; readonly sigma: number };

const changed = (line: LineId, how: Change): Promise<readonly Vector[]> =>
  how.kind === 'bend'
    ? engine.ask('bent', { line, at: how.at, to: how.to })
    : engine.ask('smoothed', { line, sigma: how.sigma });

const latest = new Latest();
let shown: Change | null = null;

export function previewLine(line: LineId, how: Change): void {
  shown = how;
  latest.run(async () => {
    const points = await changed(line, how).catch(recover);
    // The drag may have ended meanwhile.
    if (shown === how && points) {
      showReshaped(points);
    }
  });
}

export function forgetLinePreview(): void {
  shown = null;
  showReshaped(null);
}

export async function reshapeLine(id: number): Promise<void> {
  const how = shown;
  if (how) {
    const vessel = vesselOf(document_.value, id);
    const isLost = vessel !== null && vessel.contours.length > 0;
    const words = `The contours by hand of ${vessel && nameOf(vessel)} lay on its old line and were removed; undo returns them.`;
    const isDone = await commit({ ...how, id });
    if (isDone && isLost) {
      showMessage(words);
    }
    if (shown === how) {
      forgetLinePreview();
    }
  }
}
