/** Thickness and mode of a slab. */
import type { Slices } from '../core/messages';
import { SLAB_MODES, THICKEST } from '../core/slices';

interface SlabFieldProps {
  readonly slab: Slices['slab'];
  choose(slab: Slices['slab']): void;
}

export function SlabField({ slab, choose }: SlabFieldProps) {
  const [thickness, mode] = slab ?? [0, SLAB_MODES[0]?.[0] ?? ''];
  return (
    <>
      <label>
        <span>Slab</span>
        <input
          class="number"
          type="number"
          min="0"
          max={THICKEST}
          step="1"
          value={String(thickness)}
          onChange={(event) => {
            const wanted = Math.min(Number(event.currentTarget.value), THICKEST);
            choose(wanted > 0 ? [wanted, mode] : null);
          }}
        />
        <small>mm</small>
      </label>
      {slab && (
        <select
          aria-label="Values of the slab"
          value={mode}
          onChange={(event) => choose([thickness, event.currentTarget.value])}
        >
          {SLAB_MODES.map(([name, words]) => (
            <option key={name} value={name}>
              {words}
            </option>
          ))}
        </select>
      )}
    </>
  );
}
