/** What can be chosen of a straightened vessel. */
import type { ComponentChildren } from 'preact';
import type { Feature, Roll } from '../core/messages';
import * as store from '../state/store';

/** The rotation of one step of the wheel (radians). */
export const TURN_STEP = Math.PI / 36;

/** The rotation about the vessel or the side that it follows, and which value a pixel shows. */
export function CprControls({ children }: { readonly children?: ComponentChildren }) {
  const degrees = Math.round((store.cprAngle.value * 180) / Math.PI);
  const isRolled = store.cprRoll.value !== null && store.cprFeature.value === null;
  return (
    <div class="pane-controls">
      <input
        type="range"
        min="-180"
        max="180"
        step="5"
        value={String(((((degrees + 180) % 360) + 360) % 360) - 180)}
        aria-label="Rotation about the vessel (degrees)"
        disabled={isRolled}
        onInput={(event) => {
          store.cprAngle.value = (Number(event.currentTarget.value) * Math.PI) / 180;
        }}
      />
      <output>{isRolled ? '' : `${degrees}°`}</output>
      <select
        aria-label="What a pixel shows"
        value={store.cprFeature.value ?? ''}
        onChange={(event) => {
          store.cprFeature.value = (event.currentTarget.value || null) as Feature | null;
        }}
      >
        <option value="">CPR</option>
        <option value="max">CFA, largest</option>
        <option value="mean">CFA, mean</option>
        <option value="min">CFA, smallest</option>
      </select>
      {store.cprFeature.value === null && (
        <select
          aria-label="Side of the lumen"
          value={store.cprRoll.value ?? ''}
          onChange={(event) => {
            store.cprRoll.value = (event.currentTarget.value || null) as Roll | null;
          }}
        >
          <option value="">fixed angle</option>
          <option value="narrowest">narrowest side</option>
          <option value="widest">widest side</option>
        </select>
      )}
      {children}
    </div>
  );
}
