/** Markers over a view for pending points, and for the point that caused an error. */
import type { Failure } from '../core/failure';
import type { Vector } from '../core/messages';
import { candidate, coming, drawnColor, first } from '../state/drawing';
import { editQueue, isGap } from '../state/edit-queue';
import { problem } from '../state/store';
import { isNear } from './curves';
import type { Projection } from './projection';

export function Places({ projection }: { readonly projection: Projection }) {
  const refused = editQueue.state.refusal?.failure;
  // Only while the message about the error is shown.
  const weakest = refused && refused === problem.value ? refused.place : null;
  return (
    <>
      {first.value && <PointMarker kind="first" point={first.value} projection={projection} />}
      {coming.value.map(({ point }) => (
        <PointMarker key={point.join()} kind="coming" point={point} projection={projection} />
      ))}
      {candidate.value && <PointMarker kind="candidate" point={candidate.value} projection={projection} />}
      {weakest && (
        <PointMarker
          kind="weakest"
          point={weakest}
          projection={projection}
          words={refused ? wordsOf(refused) : ''}
        />
      )}
    </>
  );
}

function wordsOf(failure: Failure): string {
  const { value } = failure;
  const words = isGap(failure) ? 'least lumen-like point' : 'here';
  return value === null ? words : `${words}: ${Number.isInteger(value) ? value : value.toFixed(1)}`;
}

interface PointMarkerProps {
  readonly kind: string;
  readonly point: Vector;
  readonly projection: Projection;
  readonly words?: string;
}

function PointMarker({ kind, point, projection, words }: PointMarkerProps) {
  const [left, top] = projection.pixel(point);
  const isFar = !isNear(projection, point);
  return (
    <span
      class={`place ${kind}${isFar ? ' far' : ''}`}
      data-place={kind}
      style={{ left: `${left}px`, top: `${top}px`, '--color': drawnColor.value }}
    >
      {words && !isFar ? <b>{words}</b> : null}
    </span>
  );
}
