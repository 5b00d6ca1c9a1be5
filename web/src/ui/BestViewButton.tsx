/** Button that turns the view so that most of the picked vessel is visible. */

import { showBestView } from '../state/actions';

export function BestViewButton() {
  return (
    <button
      type="button"
      title="Turns the view so that most of the vessel is visible (f)"
      onClick={() => void showBestView()}
    >
      Best view
    </button>
  );
}
