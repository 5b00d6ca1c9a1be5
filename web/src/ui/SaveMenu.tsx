/** What can be saved of the turning view. */
import { Failure } from '../core/failure';
import { savePng } from '../output/pictures';
import { saveFilm, savePictures } from '../output/turntable';
import { problem } from '../state/store';

export function SaveMenu() {
  return (
    <details class="menu">
      <summary>Save</summary>
      <div class="menu-body">
        <button type="button" onClick={() => attempt(() => savePng('labels'))}>
          Picture with labels (PNG)
        </button>
        <button type="button" onClick={() => attempt(() => savePng('plain'))}>
          Picture without labels (PNG)
        </button>
        <button type="button" onClick={() => attempt(saveFilm)}>
          Turntable (WebM)
        </button>
        <button type="button" onClick={() => attempt(savePictures)}>
          Turntable (PNGs)
        </button>
      </div>
    </details>
  );
}

function attempt(save: () => Promise<void>): void {
  save().catch((error: unknown) => {
    problem.value = Failure.of(error);
  });
}
