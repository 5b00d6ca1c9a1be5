/** Bar shown while the user turns the view about a place: the angle, and the diameters seen in the cut. */
import { useEffect, useRef } from 'preact/hooks';
import { focusSoon } from '../input/focus';
import { diameterAfter, endPlaceTurn, type PlaceTurn, placeTurn, turnTo } from '../state/place-turn';
import { mm } from './words';

export function PlaceTurnBar() {
  const turn = placeTurn.value;
  const isOn = turn !== null;
  const wasOn = useRef(false);
  useEffect(() => {
    if (isOn) {
      focusSoon('[data-testid="place-turn"] input');
    } else if (wasOn.current && document.activeElement === document.body) {
      // The bar that had the focus is gone, so focus the view.
      focusSoon('[data-testid="turning"]');
    }
    wasOn.current = isOn;
  }, [isOn]);
  return turn && <Bar turn={turn} />;
}

function Bar({ turn }: { readonly turn: PlaceTurn }) {
  const cut = diameterAfter(turn, turn.angle);
  return (
    <section class="place-turn" aria-label="Turn about a place" data-testid="place-turn">
      <strong>{`Turn about ${mm(turn.at, 1)}`}</strong>
      <input
        type="range"
        class="place-turn-angle"
        min="-180"
        max="179"
        step="1"
        value={String(turn.angle)}
        aria-label="Angle of the turn (degrees)"
        title="Or drag in the view"
        onInput={(event) => turnTo(Number(event.currentTarget.value))}
      />
      <span class="place-turn-degrees">{`${turn.angle}°`}</span>
      <button type="button" onClick={endPlaceTurn} title="Keeps the view as it is (Escape)">
        Done
      </button>
      <p
        role="status"
        title="Diameter where values are halfway between lumen and surroundings. A rough guide, not a measurement."
      >
        <b>{`this cut: ${diameterText(cut)}`}</b>
        {turn.least !== null &&
          ` · smallest so far ${diameterText(turn.least)} · largest so far ${diameterText(turn.largest)}`}
      </p>
    </section>
  );
}

const diameterText = (diameter: number | null): string =>
  diameter === null ? 'wall not visible' : mm(diameter, 1);
