/** Grips of the picked vessel's line in a slice or section, and the line while it is dragged. */
import { useState } from 'preact/hooks';
import type { DocumentVessel, Pair, Vector } from '../core/messages';
import { add } from '../core/vectors';
import { forgetLinePreview, previewLine, reshapeLine } from '../edit/reshaping';
import { Handle } from '../pane/Handle';
import { nameOf } from '../state/changes';
import { contents } from '../state/lines';
import { isReshaping, reshapedLine } from '../state/reshaping';
import { tree } from '../state/shown';
import { pickedVessel } from '../state/store';
import { pathData } from './curves';
import { gripsOf, type LinePlace } from './line-grips';
import type { Projection } from './projection';

interface LineGripsProps {
  readonly projection: Projection;
  /** The place of the section; a slice has grips wherever the line lies in it. */
  readonly only?: LinePlace;
}

export function LineGrips({ projection, only }: LineGripsProps) {
  const vessel = tree.value[pickedVessel.value ?? -1];
  const points = vessel && contents.value.get(vessel.line)?.points;
  if (!isReshaping.value || !points) {
    return null;
  }
  const places = only ? [only] : gripsOf(points, projection);
  const changed = reshapedLine.value;
  return (
    <>
      {changed && (
        <svg class="curves" aria-hidden="true">
          <path
            class="live"
            d={`${pathData(changed, projection, 'near')}${pathData(changed, projection, 'far')}`}
            stroke={vessel.color}
          />
        </svg>
      )}
      {places.map((place, n) => (
        <LineGrip key={n} vessel={vessel} place={place} number={n + 1} projection={projection} />
      ))}
    </>
  );
}

interface LineGripProps {
  readonly vessel: DocumentVessel;
  readonly place: LinePlace;
  readonly number: number;
  readonly projection: Projection;
}

function LineGrip({ vessel, place, number, projection }: LineGripProps) {
  const { at, point } = place;
  const [dragged, setDragged] = useState<Pair | null>(null);
  const end = () => setDragged(null);
  const move = (to: Vector) => previewLine(vessel.line, { kind: 'bend', at, to });
  return (
    <Handle
      at={dragged ?? projection.pixel(point)}
      words={`Grip ${number} of the line of ${nameOf(vessel)}`}
      color={vessel.color}
      kind="grip line-grip"
      onDrag={(pixel) => {
        setDragged(pixel);
        move(projection.at(pixel, point));
      }}
      onArrow={(by) => move(add(point, projection.step(by)))}
      onEnd={() => void reshapeLine(vessel.id).then(end)}
      onPutBack={() => {
        forgetLinePreview();
        end();
      }}
    />
  );
}
