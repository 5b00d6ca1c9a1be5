/** Buttons of a slice: turning the planes, making them standard again, and their slab. */
import { isTurned } from '../core/slices';
import { SlabField } from '../pane/SlabField';
import { areLinesShown, chooseSlab, straighten, toggleLines } from '../state/slices';
import { slices } from '../state/store';

export function SliceTools() {
  const areShown = areLinesShown.value;
  return (
    <div class="pane-controls slice-tools">
      {areShown && (
        <>
          <SlabField slab={slices.value.slab} choose={chooseSlab} />
          <button
            type="button"
            class="small"
            disabled={!isTurned(slices.value)}
            title="Makes the planes axial, coronal and sagittal again"
            onClick={straighten}
          >
            Reset planes
          </button>
        </>
      )}
      <button
        type="button"
        class="small"
        aria-pressed={areShown}
        title="Shows the lines of the planes: drag a line to move its plane, or its end to turn it (x)"
        onClick={toggleLines}
      >
        Turn planes
      </button>
    </div>
  );
}
