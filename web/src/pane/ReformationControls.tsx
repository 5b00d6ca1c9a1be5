/** Controls of reformations other than the straightened CPR. */
import type { MapOf, Reformation } from '../core/messages';
import { chooseMap, mapOf, setUncurled, uncurled } from '../state/reformation';

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
  return null;
}
