/** Controls of the straightened CPR. */
import type { Feature, Roll } from '../core/messages';
import * as store from '../state/store';
import { PlayButton } from './PlayButton';

export function CprControls() {
  const degrees = Math.round((store.cprAngle.value * 180) / Math.PI);
  const isRolled = store.cprRoll.value !== null;
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
        onInput={(event) => store.setCprAngle(Number(event.currentTarget.value))}
      />
      <PlayButton kind="roll" disabled={isRolled} />
      <output>{isRolled ? '' : `${degrees}°`}</output>
      <select
        aria-label="What a pixel shows"
        title="CPR: curved planar reformation. CFA: curvicircular feature aggregation, one value for each half circle around the vessel"
        value={store.cprFeature.value ?? store.cprRoll.value ?? ''}
        onChange={(event) => choose(event.currentTarget.value)}
      >
        <option value="">CPR</option>
        <option value="narrowest">CPR, narrowest</option>
        <option value="widest">CPR, widest</option>
        <option value="max">CFA, largest</option>
        <option value="mean">CFA, mean</option>
        <option value="min">CFA, smallest</option>
      </select>
    </div>
  );
}

function choose(name: string): void {
  const isRoll = name === 'narrowest' || name === 'widest';
  store.chooseCpr({
    roll: isRoll ? (name as Roll) : null,
    feature: isRoll ? null : ((name || null) as Feature | null),
  });
}
