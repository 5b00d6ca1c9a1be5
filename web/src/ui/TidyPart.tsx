/** "Clean up": limits mark short or thin vessels. Buttons remove these, or all not connected to the picked vessel. */
import { keepPart, removeMarked } from '../edit/vessels';
import { hasMillimetres } from '../state/millimetres';
import {
  factsOf,
  marked,
  markShorterThan,
  markThinnerThan,
  reachOf,
  shorterThan,
  sure,
  thinnerThan,
  unconnected,
} from '../state/tidying';

/** Usual ends of the sliders (mm); the number fields accept more. */
const USUAL_LENGTH = 60;
const USUAL_CALIBRE = 10;

export function TidyPart() {
  if (sure.value.length < 2) {
    return null;
  }
  const count = marked.value.size;
  const known = sure.value.map(factsOf);
  const lengths = known.flatMap((facts) => facts?.length ?? []);
  const calibres = known.flatMap((facts) => facts?.calibre ?? []);
  return (
    <details class="tidy">
      <summary>Clean up</summary>
      <Limit
        words="Shorter than"
        limit={shorterThan.value}
        mark={markShorterThan}
        most={reachOf(lengths, USUAL_LENGTH)}
        step={1}
      />
      {calibres.length > 0 && (
        <Limit
          words="Thinner than"
          limit={thinnerThan.value}
          mark={markThinnerThan}
          most={reachOf(calibres, USUAL_CALIBRE)}
          step={0.1}
        />
      )}
      <div class="buttons">
        <button type="button" disabled={count === 0} onClick={() => void removeMarked()}>
          {removeWords(count)}
        </button>
        <button
          type="button"
          disabled={unconnected.value.length === 0}
          title="Removes all vessels that are not connected to the picked vessel"
          onClick={() => void keepPart()}
        >
          {unconnected.value.length > 0
            ? `Keep only this tree (removes ${unconnected.value.length})`
            : 'Keep only this tree'}
        </button>
      </div>
    </details>
  );
}

function removeWords(count: number): string {
  if (count === 0) {
    return 'Remove marked vessels';
  }
  return count === 1 ? 'Remove 1 vessel' : `Remove ${count} vessels`;
}

interface LimitProps {
  readonly words: string;
  readonly limit: number;
  readonly mark: (limit: number) => void;
  readonly most: number;
  readonly step: number;
}

/** A slider and a number field for a limit (mm); the number may lie beyond the slider. */
function Limit({ words, limit, mark, most, step }: LimitProps) {
  const take = (event: { readonly currentTarget: HTMLInputElement }) => {
    // An empty field means 0, which marks no vessel.
    mark(Math.max(Number(event.currentTarget.value), 0));
  };
  const unit = hasMillimetres.value ? ' (mm)' : '';
  return (
    <div class="tidy-limit">
      <span>{words}</span>
      <input
        type="range"
        aria-label={words}
        min="0"
        max={Math.max(Math.ceil(most / step) * step, step)}
        step={step}
        value={limit}
        onInput={take}
      />
      <input type="number" aria-label={`${words}${unit}`} min="0" step={step} value={limit} onInput={take} />
      <span>{hasMillimetres.value ? 'mm' : ''}</span>
    </div>
  );
}
