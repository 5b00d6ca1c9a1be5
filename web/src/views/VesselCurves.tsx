/** Draws the vessels as curves over a view, and the preview of the traced path. */

import type { DocumentVessel, Vector } from '../core/messages';
import { DOUBTFUL } from '../state/changes';
import { drawnColor, livePaths, whole } from '../state/drawing';
import { document_ } from '../state/history';
import { contents } from '../state/lines';
import { tree } from '../state/shown';
import { crossHair, MOST_WITH_LINES, pickedVessel } from '../state/store';
import { highlighted, marked } from '../state/tidying';
import { active, areDoubtfulShown, chosenDoubt, isTracing, tool } from '../state/tool';
import { passesNear, pathData } from './curves';
import type { Projection } from './projection';

/** If many vessels are shown, others farther from the cross-hair (mm) are drawn only where a slice cuts them. */
const FAR = 25;

function isDrawnWhole(vessel: DocumentVessel): boolean {
  const hair = crossHair.value;
  return (
    tree.value.length <= MOST_WITH_LINES ||
    vessel.id === active.value ||
    (hair !== null && passesNear(contents.value.get(vessel.line)?.points ?? [], hair.point, FAR))
  );
}

interface OverProps {
  readonly projection: Projection;
}

export function VesselCurves({ projection }: OverProps) {
  const isOn = isTracing();
  const picked = tree.value[pickedVessel.value ?? -1]?.id;
  // Over the cut, curves would hide the vessels.
  const isSeen = (vessel: DocumentVessel) =>
    vessel.id === highlighted.value ||
    vessel.id === chosenDoubt.value ||
    (isOn && vessel.id === picked) ||
    (!vessel.isHidden &&
      (vessel.doubt === null || areDoubtfulShown.value) &&
      (!projection.isThrough ||
        (isOn && isDrawnWhole(vessel)) ||
        vessel.doubt !== null ||
        marked.value.has(vessel.id)));
  return (
    <svg class="curves" aria-hidden="true">
      {document_.value.vessels.filter(isSeen).map((vessel) => (
        <Curve
          key={vessel.id}
          vessel={vessel}
          projection={projection}
          isPicked={vessel.id === picked}
          hasFar={isOn && !projection.isThrough && (vessel.id === picked || isDrawnWhole(vessel))}
        />
      ))}
      <LivePaths projection={projection} />
    </svg>
  );
}

interface CurveProps extends OverProps {
  readonly vessel: DocumentVessel;
  readonly isPicked: boolean;
  readonly hasFar: boolean;
}

function Curve({ vessel, projection, isPicked, hasFar }: CurveProps) {
  const [isLit, isMarked] = [
    vessel.id === highlighted.value || vessel.id === chosenDoubt.value,
    marked.value.has(vessel.id),
  ];
  const points = contents.value.get(vessel.line)?.points;
  if (!points) {
    return null;
  }
  const kind = `curve${vessel.doubt !== null ? ' doubtful' : isPicked ? ' picked' : ''}${isLit ? ' lit' : ''}${isMarked ? ' marked' : ''}`;
  const color = vessel.doubt === null ? vessel.color : DOUBTFUL;
  return (
    <g class={kind} stroke={color} data-vessel={vessel.id}>
      {hasFar && <path class="far" d={pathData(points, projection, 'far')} />}
      {vessel.doubt === null ? (
        <Cased kind="near" d={pathData(points, projection, 'near')} />
      ) : (
        <path class="near" d={pathData(points, projection, 'near')} />
      )}
    </g>
  );
}

function LivePaths({ projection }: OverProps) {
  if (tool.value === 'look') {
    return null;
  }
  return (
    <>
      {whole.value && (
        <g stroke={drawnColor.value} data-testid="whole-vessel">
          <Cased
            kind="live whole"
            d={`${pathData(whole.value.points, projection, 'near')}${pathData(whole.value.points, projection, 'far')}`}
          />
        </g>
      )}
      {livePaths.value.map(({ points, isFound }) => (
        <g key={textOf(points)} stroke={drawnColor.value}>
          <Cased
            kind={isFound ? 'live' : 'live missing'}
            d={`${pathData(points, projection, 'near')}${pathData(points, projection, 'far')}`}
          />
        </g>
      ))}
    </>
  );
}

function Cased({ kind, d }: { readonly kind: string; readonly d: string }) {
  return (
    <>
      <path class="casing" d={d} />
      <path class={kind} d={d} />
    </>
  );
}

const textOf = (points: readonly Vector[]): string => `${points[0]?.join()} ${points.at(-1)?.join()}`;
