/** The grey-value window over the histogram. Its ends and its middle can be dragged or moved by arrow keys. */
import { useRef } from 'preact/hooks';
import type { Window } from '../core/messages';
import { setWindow } from '../state/actions';
import { windowChanged } from '../state/history';
import * as store from '../state/store';
import { Scale } from './value-axis';
import { WindowPresets } from './WindowPresets';

const WIDTH = 220;
const HEIGHT = 26;

export function WindowStrip() {
  const histogram = store.histogram.value;
  const [level, width] = store.window_.value;
  if (!histogram) {
    return null;
  }
  const scale = new Scale(histogram, store.report.value?.windows?.main ?? store.window_.value, [
    WIDTH,
    HEIGHT,
  ]);
  return (
    <div class="window-strip">
      <svg width={WIDTH} height={HEIGHT} aria-hidden="true" class="histogram">
        <path d={scale.outline(histogram)} />
        <rect
          x={scale.x(level - width / 2)}
          width={Math.max(scale.x(level + width / 2) - scale.x(level - width / 2), 1)}
          height={HEIGHT}
        />
      </svg>
      <Handle
        scale={scale}
        value={level - width / 2}
        words="Black"
        change={(low) => setWindow(between(low, level + width / 2))}
      />
      <Handle scale={scale} value={level} words="Level" change={(middle) => setWindow([middle, width])} />
      <Handle
        scale={scale}
        value={level + width / 2}
        words="White"
        change={(high) => setWindow(between(level - width / 2, high))}
      />
      <WindowPresets />
    </div>
  );
}

/** The window from black at `low` to white at `high`; white stays above black. */
function between(low: number, high: number): Window {
  return [(low + high) / 2, Math.max(high - low, 1e-3)];
}

interface HandleProps {
  readonly scale: Scale;
  readonly value: number;
  readonly words: string;
  readonly change: (value: number) => void;
}

function Handle({ scale, value, words, change }: HandleProps) {
  const start = useRef<{ x: number; value: number } | null>(null);
  const before = useRef<Window>(store.window_.value);
  const begin = () => {
    before.current = store.window_.value;
  };
  const end = () => windowChanged(before.current);
  const move = (event: PointerEvent) => {
    if (start.current) {
      change(start.current.value + (event.clientX - start.current.x) * scale.perPixel);
    }
  };
  const key = (event: KeyboardEvent) => {
    const direction = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (direction) {
      event.preventDefault();
      if (!event.repeat) {
        begin();
      }
      change(value + direction * scale.perPixel * (event.shiftKey ? 10 : 1));
    }
  };
  return (
    <div
      class={`handle ${words.toLowerCase()}`}
      style={{ left: `${scale.x(value)}px` }}
      role="slider"
      tabIndex={0}
      aria-label={`${words} of the window`}
      aria-valuenow={Math.round(value)}
      aria-valuemin={Math.round(scale.low)}
      aria-valuemax={Math.round(scale.high)}
      onPointerDown={(event) => {
        begin();
        start.current = { x: event.clientX, value };
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={move}
      onPointerUp={() => {
        start.current = null;
        end();
      }}
      onKeyDown={key}
      onKeyUp={(event) => (event.key.startsWith('Arrow') ? end() : undefined)}
    />
  );
}
