/** The lines of the other planes in a slice. A drag of a line moves its plane, a drag of its end turns both. */
import { useRef } from 'preact/hooks';
import type { Pair, Plane, Vector } from '../core/messages';
import { normalOf, pixelOn, pointOn, type SliceName } from '../core/planes';
import { lineOf, lineWithin, SLICE_NAMES } from '../core/slices';
import { add, dot, scale, subtract } from '../core/vectors';
import { Handle } from '../pane/Handle';
import { jumpTo, moveCrossHair } from '../state/cross-hair';
import { areLinesShown, beginTurn, endTurn, putTurnBack, turnBySteps, turnPlanes } from '../state/slices';
import { crossHair, slices } from '../state/store';

/** Colours of the planes, as in 3D Slicer. */
export const PLANE_COLORS: Readonly<Record<SliceName, string>> = {
  axial: '#ff6b5e',
  coronal: '#7ed07e',
  sagittal: '#f2d64b',
};

/** Distances in CSS pixels: of the ends from the edges, of the lines from the cross-hair, of the ends from it at least. */
const EDGE = 44;
const GAP = 22;
const LEAST = 48;

interface LinesProps {
  readonly name: SliceName;
  readonly plane: Plane;
  readonly point: Vector;
}

export function PlaneLines({ name, plane, point }: LinesProps) {
  if (!areLinesShown.value) {
    return null;
  }
  const others = SLICE_NAMES.filter((other) => other !== name);
  return (
    <>
      {others.map((other) => (
        <PlaneLine key={other} name={name} plane={plane} point={point} other={other} />
      ))}
    </>
  );
}

interface LineProps extends LinesProps {
  readonly other: SliceName;
}

function PlaneLine({ other, ...view }: LineProps) {
  const { name, plane, point } = view;
  const through = pixelOn(plane, point);
  const along = lineOf(slices.value, name, other);
  const ends = lineWithin(through, along, plane, EDGE);
  if (!ends) {
    return null;
  }
  const at = (part: number): Pair => [through[0] + part * along[0], through[1] + part * along[1]];
  const parts: Pair[] = [
    [ends[0], Math.min(ends[1], -GAP)],
    [Math.max(ends[0], GAP), ends[1]],
  ];
  const shown = parts.filter(([from, to]) => from < to);
  return (
    <>
      <svg class="place-lines" width="100%" height="100%" aria-hidden="true">
        <path
          d={shown.map(([from, to]) => `M${at(from)}L${at(to)}`).join('')}
          stroke={PLANE_COLORS[other]}
          stroke-width="1.5"
        />
      </svg>
      {shown.map(([from, to], n) => (
        <LineGrip
          key={`line ${n}`}
          {...{ ...view, other, along }}
          at={at((from + to) / 2)}
          length={to - from}
        />
      ))}
      {ends
        .filter((part) => Math.abs(part) >= LEAST)
        .map((part) => (
          <EndGrip key={`end ${Math.sign(part)}`} {...{ ...view, other, through }} at={at(part)} />
        ))}
    </>
  );
}

interface LineGripProps extends LineProps {
  readonly along: Pair;
  readonly at: Pair;
  readonly length: number;
}

function LineGrip({ name, plane, other, along, at, length }: LineGripProps) {
  const last = useRef<Pair | null>(null);
  const begun = useRef<Vector | null>(null);
  const move = (pixel: Pair) => {
    const [from, hair] = [last.current, crossHair.value];
    if (from && hair) {
      const normal = normalOf(slices.value[other]);
      const by = dot(normal, subtract(pointOn(plane, pixel), pointOn(plane, from)));
      moveCrossHair(add(hair.point, scale(normal, by)), name);
    }
    last.current = pixel;
  };
  return (
    <Handle
      at={at}
      words={`Line of the ${other} plane in the ${name} slice: a drag moves the plane`}
      color={PLANE_COLORS[other]}
      kind="plane-line"
      style={{ width: `${length}px`, '--angle': `${Math.atan2(along[1], along[0])}rad` }}
      isReachable={false}
      onBegin={() => {
        [last.current, begun.current] = [null, crossHair.value?.point ?? null];
      }}
      onDrag={move}
      onEnd={() => {
        last.current = null;
      }}
      onPutBack={() => begun.current && jumpTo(begun.current)}
    />
  );
}

interface EndGripProps extends LineProps {
  readonly through: Pair;
  readonly at: Pair;
}

function EndGrip({ name, other, through, at }: EndGripProps) {
  const from = useRef<number | null>(null);
  const angleOf = (pixel: Pair) => Math.atan2(pixel[1] - through[1], pixel[0] - through[0]);
  return (
    <Handle
      at={at}
      words={`End of the line of the ${other} plane in the ${name} slice: a drag turns both planes`}
      color={PLANE_COLORS[other]}
      kind="plane-end"
      isReachable={false}
      onBegin={() => {
        from.current = null;
        beginTurn();
      }}
      onDrag={(pixel) => {
        const angle = angleOf(pixel);
        from.current ??= angle;
        turnPlanes(name, angle - from.current);
      }}
      onArrow={([x, y]) => turnBySteps(name, x + y)}
      onEnd={endTurn}
      onPutBack={putTurnBack}
    />
  );
}
