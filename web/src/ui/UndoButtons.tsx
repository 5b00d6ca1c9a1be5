/** Buttons for undo and redo. */

import { performAny } from '../edit/performing';
import { redoWords, undoWords } from '../state/history';
import { hasVolume } from '../state/store';

export function UndoButtons() {
  if (!hasVolume.value) {
    return null;
  }
  const [back, forth] = [undoWords.value, redoWords.value];
  return (
    <span class="undo">
      <button
        type="button"
        aria-label="Undo"
        disabled={back === null}
        title={back ? `Undo: ${back} (Ctrl+z)` : 'Nothing to undo'}
        onClick={() => performAny('undo')}
      >
        ↶
      </button>
      <button
        type="button"
        aria-label="Redo"
        disabled={forth === null}
        title={forth ? `Redo: ${forth} (Ctrl+Shift+z)` : 'Nothing to redo'}
        onClick={() => performAny('redo')}
      >
        ↷
      </button>
    </span>
  );
}
