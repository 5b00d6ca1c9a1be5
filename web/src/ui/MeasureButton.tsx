/** Shows and leaves the layout that measures the picked vessel. */
import { toggleMeasuring } from '../state/actions';
import { layout } from '../state/store';

export function MeasureButton() {
  return (
    <button type="button" aria-pressed={layout.value === 'measure'} onClick={toggleMeasuring}>
      Measure
    </button>
  );
}
