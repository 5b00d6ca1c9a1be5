/** Draws the clicked points of vessels over a view. They can be dragged, moved by keys and removed. */

import type { DocumentVessel, Vector } from '../core/messages';
import { add } from '../core/vectors';
import { moveClick, removeClick } from '../edit/clicks';
import { setPoint } from '../edit/pointing';
import { Handle } from '../pane/Handle';
import { nameOf } from '../state/changes';
import { lookAt } from '../state/cross-hair';
import { dragClick, dragged, isDrawing } from '../state/drawing';
import { document_ } from '../state/history';
import { pickedId } from '../state/shown';
import { active, extend, isTracing, tool } from '../state/tool';
import { isNear } from './curves';
import type { Projection } from './projection';

interface OverProps {
  readonly projection: Projection;
}

export function VesselPoints({ projection }: OverProps) {
  if (!isTracing()) {
    return null;
  }
  return (
    <>
      {document_.value.vessels
        .filter((vessel) => !vessel.isHidden && vessel.clicks)
        .map((vessel) => (
          <Clicks key={vessel.id} vessel={vessel} projection={projection} />
        ))}
    </>
  );
}

/** Points of a vessel. Those outside the slice are faint, and shown only for the picked or drawn vessel. */
function Clicks({ vessel, projection }: OverProps & { readonly vessel: DocumentVessel }) {
  const isAtHand = vessel.id === active.value || vessel.id === pickedId();
  return (
    <>
      {(vessel.clicks ?? []).map((click, number) => {
        const moved = dragged.value;
        const isMoved = moved?.id === vessel.id && moved.number === number;
        const point = isMoved ? moved.point : click;
        return isMoved || isAtHand || isNear(projection, point) ? (
          <Click key={number} vessel={vessel} number={number} point={point} projection={projection} />
        ) : null;
      })}
    </>
  );
}

interface ClickProps extends OverProps {
  readonly vessel: DocumentVessel;
  readonly number: number;
  readonly point: Vector;
}

function Click({ vessel, number, point, projection }: ClickProps) {
  const { id } = vessel;
  const drag = (to: Vector) => dragClick({ id, number, point: to });
  const end = async () => {
    const moved = dragged.value;
    if (moved) {
      lookAt(moved.point);
      await moveClick(id, number, moved.point);
      dragClick(null);
    } else if (number === (vessel.clicks?.length ?? 0) - 1 && !isDrawing.value) {
      // A click on the last point extends the vessel; on another point it begins a branch or ends one there.
      extend(id);
    } else if (tool.value === 'trace' && id !== active.value) {
      await setPoint(point);
    }
  };
  return (
    <Handle
      at={projection.pixel(point)}
      words={`Point ${number + 1} of ${nameOf(vessel)}`}
      color={vessel.color}
      kind={isNear(projection, point) ? 'point' : 'point far'}
      onBegin={() => lookAt(point)}
      onDrag={(at) => drag(projection.at(at, point))}
      onArrow={(by) => drag(add(point, projection.step(by)))}
      onEnd={() => void end()}
      onPutBack={() => dragClick(null)}
      onRemove={() => void removeClick(id, number)}
    />
  );
}
