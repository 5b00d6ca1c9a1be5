/** Draws the clicked points of vessels over a view. They can be dragged, moved by keys and removed. */

import type { DocumentVessel, Vector } from '../core/messages';
import { add } from '../core/vectors';
import { moveClick, removeClick } from '../edit/clicks';
import { dragged, isDrawing } from '../edit/drawing';
import { isTracing } from '../edit/mode';
import { setPoint } from '../edit/pointing';
import { pickedId } from '../edit/shown';
import { Handle } from '../pane/Handle';
import { nameOf } from '../state/changes';
import { document_ } from '../state/history';
import { active, tool } from '../state/tool';
import { isNear } from './curves';
import { lookAt } from './look-at';
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
  const drag = (to: Vector) => {
    dragged.value = { id, number, point: to };
  };
  const end = async () => {
    const moved = dragged.value;
    if (moved) {
      lookAt(moved.point);
      await moveClick(id, number, moved.point);
      dragged.value = null;
    } else if (number === (vessel.clicks?.length ?? 0) - 1 && !isDrawing.value) {
      // A click on the last point extends the vessel; on another point it begins a branch or ends one there.
      active.value = id;
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
      onPutBack={() => {
        dragged.value = null;
      }}
      onRemove={() => void removeClick(id, number)}
    />
  );
}
