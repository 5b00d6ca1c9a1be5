/** The transfer function of the context: a name, or control points over the histogram. */
import { useEffect, useRef, useState } from 'preact/hooks';
import type { ControlPoint, SettingRow } from '../core/messages';
import {
  colorOf,
  coloured,
  hex,
  isPoints,
  movedPoint,
  type Points,
  withoutPoint,
  withPoint,
} from '../core/transfer';
import { setSetting, settingOf } from '../state/actions';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { Scale } from './value-axis';

const WIDTH = 300;
const HEIGHT = 72;
const POINTS = 'points';
/** Opacities are small, so the axis shows their square roots. */
const y = (opacity: number) => HEIGHT * (1 - Math.sqrt(opacity));
const opacityAt = (at: number) => Math.min(Math.max(1 - at / HEIGHT, 0), 1) ** 2;

export function TransferEditor({ row }: { readonly row: SettingRow }) {
  const chosen = settingOf(row.name);
  const points = isPoints(chosen) ? chosen : null;
  const set = (points: Points) => setSetting(row.name, points);
  const choose = (name: string) => {
    if (name === POINTS) {
      void pointsOf(chosen as string | null).then(set, store.showProblem);
    } else {
      setSetting(row.name, name || null);
    }
  };
  return (
    <>
      <label title={row.sentence}>
        <span>context transfer</span>
        <select
          value={points ? POINTS : String(chosen ?? '')}
          onChange={(event) => choose(event.currentTarget.value)}
        >
          <option value="">{row.open}</option>
          {[...row.choices, POINTS].map((name) => (
            <option key={name} value={name}>
              {name}
            </option>
          ))}
        </select>
      </label>
      {points && <Curve points={points} set={set} />}
    </>
  );
}

/** The control points of a named function in the window of the context. */
function pointsOf(name: string | null): Promise<Points> {
  const usual = settingOf('context') === 'mip' ? 'grey' : 'angio';
  const window = (store.viewSettings.value.context_window ?? store.window_.value) as readonly [
    number,
    number,
  ];
  return engine.ask('transfer_points', { name: name ?? usual, window: [...window] });
}

function Curve({ points, set }: { readonly points: Points; readonly set: (points: Points) => void }) {
  const [picked, setPicked] = useState(0);
  const histogram = store.histogram.value;
  if (!histogram) {
    return null;
  }
  const scale = new Scale(histogram, store.report.value?.windows?.main ?? store.window_.value, [
    WIDTH,
    HEIGHT,
  ]);
  const places = points.map(([intensity, , opacity]) => [scale.x(intensity), y(opacity)] as const);
  const [first, last] = [places[0], places.at(-1)];
  const line = [[0, first?.[1]], ...places, [WIDTH, last?.[1]]].join(' ');
  const at = Math.min(picked, points.length - 1);
  const add = (intensity: number, opacity: number) => {
    const [added, place] = withPoint(points, intensity, opacity);
    set(added);
    setPicked(place);
  };
  return (
    <div class="transfer">
      <svg
        width={WIDTH}
        height={HEIGHT}
        class="curve"
        onDblClick={(event) => add(scale.low + event.offsetX * scale.perPixel, opacityAt(event.offsetY))}
      >
        <title>Opacity over intensity; double-click adds a point</title>
        <path d={scale.outline(histogram)} />
        <polyline points={line} />
      </svg>
      {points.map((point, n) => (
        <Point
          key={n}
          point={point}
          scale={scale}
          words={`Point ${n + 1} of ${points.length}`}
          isPicked={n === at}
          pick={() => setPicked(n)}
          move={(intensity, opacity) => set(movedPoint(points, n, intensity, opacity))}
          remove={() => set(withoutPoint(points, n))}
        />
      ))}
      <PickedPoint points={points} at={at} set={set} add={add} />
    </div>
  );
}

interface PickedProps {
  readonly points: Points;
  readonly at: number;
  readonly set: (points: Points) => void;
  readonly add: (intensity: number, opacity: number) => void;
}

/** The numbers and the colour of the picked point. */
function PickedPoint({ points, at, set, add }: PickedProps) {
  const point = points[at];
  if (!point) {
    return null;
  }
  const [intensity, color, opacity] = point;
  const next = points[at + 1] ?? points[at - 1] ?? [intensity + 100, color, opacity];
  return (
    <div class="picked-point">
      <input
        type="color"
        aria-label="Colour of the point"
        value={hex(color)}
        onInput={(event) => set(coloured(points, at, colorOf(event.currentTarget.value)))}
      />
      <output>
        {Math.round(intensity)} · {Number(opacity.toPrecision(2))} per mm
      </output>
      <button
        type="button"
        class="stays"
        onClick={() => add((intensity + next[0]) / 2, (opacity + next[2]) / 2)}
      >
        Add
      </button>
      <button
        type="button"
        class="stays"
        disabled={points.length < 2}
        onClick={() => set(withoutPoint(points, at))}
      >
        Remove
      </button>
    </div>
  );
}

interface PointProps {
  readonly point: ControlPoint;
  readonly scale: Scale;
  readonly words: string;
  readonly isPicked: boolean;
  readonly pick: () => void;
  readonly move: (intensity: number, opacity: number) => void;
  readonly remove: () => void;
}

function Point({ point, scale, words, isPicked, pick, move, remove }: PointProps) {
  const [intensity, color, opacity] = point;
  const start = useRef<{ x: number; y: number; from: ControlPoint } | null>(null);
  const self = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (isPicked && self.current?.parentElement?.contains(document.activeElement)) {
      self.current.focus();
    }
  }, [isPicked]);
  const key = (event: KeyboardEvent) => {
    const step = event.shiftKey ? 10 : 1;
    const across = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const up = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (across) {
      move(intensity + across * step * scale.perPixel, opacity);
    } else if (up) {
      move(intensity, opacityAt(y(opacity) + up * step));
    } else if (event.key === 'Delete' || event.key === 'Backspace') {
      remove();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <div
      ref={self}
      class={isPicked ? 'transfer-point picked' : 'transfer-point'}
      style={{ left: `${scale.x(intensity)}px`, top: `${y(opacity)}px`, background: hex(color) }}
      role="slider"
      tabIndex={0}
      aria-label={words}
      aria-valuenow={Math.round(intensity)}
      aria-valuetext={`${Math.round(intensity)}, opacity ${Number(opacity.toPrecision(2))} per mm`}
      onFocus={pick}
      onKeyDown={key}
      onPointerDown={(event) => {
        start.current = { x: event.clientX, y: event.clientY, from: point };
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        const begun = start.current;
        if (begun) {
          const across = (event.clientX - begun.x) * scale.perPixel;
          move(begun.from[0] + across, opacityAt(y(begun.from[2]) + event.clientY - begun.y));
        }
      }}
      onPointerUp={() => {
        start.current = null;
      }}
    />
  );
}
