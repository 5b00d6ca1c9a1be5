/** Moves and smooths the line of a vessel by hand, with a preview. */
import { Latest } from '../core/latest';
import type { LineId, Reshaping } from '../core/messages';
import { recover } from '../state/device';
import { showReshaped } from '../state/reshaping';
import { engine } from '../worker/engine';
import { commit } from './committing';

const latest = new Latest();
/** The change that is previewed; null while there is none. */
let shown: Reshaping | null = null;

export function previewLine(line: LineId, how: Reshaping): void {
  shown = how;
  latest.run(async () => {
    const points = await engine.ask('reshaped', { line, how }).catch(recover);
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

/** Makes the previewed change an edit of the vessel. */
export async function reshapeLine(id: number): Promise<void> {
  const how = shown;
  if (how) {
    await commit({ kind: 'reshape', id, how });
    if (shown === how) {
      forgetLinePreview();
    }
  }
}
