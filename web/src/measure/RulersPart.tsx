/** List of the straight distances that the user has measured. */
import { document_ } from '../state/history';
import { firstEnd, removeRuler, rulerLength, toggleRuler } from '../state/rulers';
import { tool } from '../state/tool';
import { mm } from './words';

export function RulersPart() {
  const isDrawing = tool.value === 'ruler';
  return (
    <section aria-label="Distances">
      <h3>Distances</h3>
      {document_.value.rulers.map((ruler, number) => (
        <div key={`ruler ${number}`} class="place-row" data-testid="ruler">
          <strong>{`distance ${number + 1}`}</strong>
          <span>{mm(rulerLength(ruler), 1)}</span>
          <button
            type="button"
            class="small"
            aria-label={`Remove distance ${number + 1}`}
            onClick={() => removeRuler(number)}
          >
            ×
          </button>
        </div>
      ))}
      <button type="button" aria-pressed={isDrawing} onClick={toggleRuler}>
        Ruler
      </button>
      {isDrawing && (
        <span>
          {firstEnd.value ? ' Click the second point.' : ' Click two points in a slice or on the vessels.'}
        </span>
      )}
    </section>
  );
}
