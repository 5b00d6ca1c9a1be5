/** Controls of reformations other than the straightened CPR. */
import type { LensOf, MapOf, Reformation } from '../core/messages';
import {
  chooseLens,
  chooseMap,
  lensOf,
  lookBack,
  looksBack,
  mapOf,
  setUncurled,
  uncurled,
} from '../state/reformation';

const MAPS: readonly (readonly [MapOf, string])[] = [
  ['wall', 'brightest value at the wall'],
  ['radius', 'radius'],
  ['thickness', 'thickness of calcium'],
];

export function ReformationControls({ kind }: { readonly kind: Reformation['kind'] }) {
  if (kind === 'uncurl') {
    const percent = Math.round(100 * uncurled.value);
    return (
      <>
        <input
          type="range"
          min="0"
          max="100"
          step="2"
          value={String(percent)}
          aria-label="How far the vessel is straightened (percent)"
          onInput={(event) => setUncurled(Number(event.currentTarget.value) / 100)}
        />
        <output>{`${percent} %`}</output>
      </>
    );
  }
  if (kind === 'map') {
    return (
      <select
        aria-label="What the map shows"
        value={mapOf.value}
        onChange={(event) => chooseMap(event.currentTarget.value as MapOf)}
      >
        {MAPS.map(([of, words]) => (
          <option key={of} value={of}>
            {words}
          </option>
        ))}
      </select>
    );
  }
  if (kind === 'endoscopy') {
    return (
      <>
        <select
          aria-label="Lens"
          value={lensOf.value}
          onChange={(event) => chooseLens(event.currentTarget.value as LensOf)}
        >
          <option value="perspective">perspective</option>
          <option value="fisheye">fisheye</option>
        </select>
        <label>
          <input
            type="checkbox"
            checked={looksBack.value}
            onChange={(event) => lookBack(event.currentTarget.checked)}
          />
          look back
        </label>
      </>
    );
  }
  return null;
}
