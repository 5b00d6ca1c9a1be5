/** Cleaning a tree: sliders mark what is short or thin, one button removes it, another one all that is not connected. */
import type { Signal } from '@preact/signals';
import { engine } from '../client/shared';
import { apart, factsOf, keepPart, marked, removeMarked, sure } from '../edit/tidying';
import { hasMillimetres } from '../state/millimetres';
import { shorterThan, thinnerThan } from '../state/tidy';

/** Fewer vessels are tidied by hand. */
const FEW = 4;

export function TidyPart() {
  if (sure.value.length < FEW) {
    return null;
  }
  const count = marked.value.size;
  const known = sure.value.map(factsOf);
  const longest = Math.max(...known.map((facts) => facts?.length ?? 0));
  const widest = Math.max(...known.map((facts) => facts?.calibre ?? 0));
  return (
    <details class="tidy">
      <summary>Clean up</summary>
      <Limit words="Shorter than" limit={shorterThan} most={longest} step={1} />
      {widest > 0 && <Limit words="Thinner than" limit={thinnerThan} most={widest} step={0.1} />}
      <div class="buttons">
        <button type="button" disabled={count === 0} onClick={() => void removeMarked(engine)}>
          {count === 1 ? 'Remove 1 vessel' : `Remove ${count} vessels`}
        </button>
        <button
          type="button"
          disabled={apart.value.length === 0}
          title="Removes all vessels that do not hang together with the picked one"
          onClick={() => void keepPart(engine)}
        >
          {apart.value.length > 0
            ? `Keep only this tree (removes ${apart.value.length})`
            : 'Keep only this tree'}
        </button>
      </div>
    </details>
  );
}

interface LimitProps {
  readonly words: string;
  readonly limit: Signal<number>;
  readonly most: number;
  readonly step: number;
}

/** A limit (mm) from 0 to beyond the largest of all vessels. */
function Limit({ words, limit, most, step }: LimitProps) {
  return (
    <label>
      <span>{words}</span>
      <input
        type="range"
        min="0"
        max={Math.ceil(most / step + 1) * step}
        step={step}
        value={limit.value}
        onInput={(event) => {
          limit.value = Number(event.currentTarget.value);
        }}
      />
      <span class="length">{`${limit.value.toFixed(step < 1 ? 1 : 0)}${hasMillimetres.value ? ' mm' : ''}`}</span>
    </label>
  );
}
