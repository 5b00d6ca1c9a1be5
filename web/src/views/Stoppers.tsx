/** Draws the stoppers over a view, as circles that can be dragged. */

import type { Stopper, Vector } from '../core/messages';
import { add } from '../core/vectors';
import { moveStopper, removeStopper } from '../edit/clicks';
import { Handle } from '../pane/Handle';
import { lookAt } from '../state/cross-hair';
import { draggedStopper, dragStopper } from '../state/drawing';
import { document_ } from '../state/history';
import { isTracing } from '../state/tool';
import type { Projection } from './projection';

const COLOR = '#ff4d4d';

export function Stoppers({ projection }: { readonly projection: Projection }) {
  if (!isTracing()) {
    return null;
  }
  return (
    <>
      {document_.value.stoppers.map((stopper, number) => (
        <Ball key={number} number={number} stopper={stopper} projection={projection} />
      ))}
    </>
  );
}

interface BallProps {
  readonly number: number;
  readonly stopper: Stopper;
  readonly projection: Projection;
}

function Ball({ number, stopper, projection }: BallProps) {
  const moved = draggedStopper.value?.number === number ? draggedStopper.value.point : null;
  const center = moved ?? stopper.center;
  const depth = projection.isThrough ? 0 : projection.depth(center);
  const radius = Math.sqrt(Math.max(stopper.radius ** 2 - depth ** 2, 0)) / projection.spacing;
  if (radius === 0) {
    return null;
  }
  const drag = (point: Vector) => dragStopper({ number, point });
  const end = async () => {
    if (draggedStopper.value) {
      await moveStopper(number, draggedStopper.value.point);
      dragStopper(null);
    }
  };
  const [x, y] = projection.pixel(center);
  return (
    <>
      <svg class="curves" aria-hidden="true">
        <circle class="stopper" cx={x} cy={y} r={radius} stroke={COLOR} />
      </svg>
      <Handle
        at={[x, y]}
        words={`Stopper ${number + 1}`}
        color={COLOR}
        kind="point"
        onBegin={() => void lookAt(center)}
        onDrag={(at) => drag(projection.at(at, center))}
        onArrow={(by) => drag(add(center, projection.step(by)))}
        onEnd={() => void end()}
        onPutBack={() => dragStopper(null)}
        onRemove={() => void removeStopper(number)}
      />
    </>
  );
}
