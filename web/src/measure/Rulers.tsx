/** The rulers: over a picture those with both ends visible and the one being drawn, and the list of their lengths. */
import { useLayoutEffect, useRef } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { Pair, Vector } from '../core/messages';
import { Handle } from '../pane/Handle';
import { recover } from '../state/device';
import type { Ruler } from '../state/document';
import { document_ } from '../state/history';
import {
  beginRulerMove,
  type End,
  endRulerMove,
  firstEnd,
  moveRuler,
  putRulerBack,
  removeRuler,
  rulerLength,
  setRulerPoint,
  toggleRuler,
} from '../state/rulers';
import { tool } from '../state/tool';
import { mm } from './words';

const COLOR = '#ffdc00';
/** Largest movement during a click (CSS pixels). */
const CLICK_WITHIN = 4;

/** How a picture maps world points to pixels. */
export interface Seen {
  readonly where: string;
  pixelOf(point: Vector): Pair;
  pointAt(pixel: Pair): Promise<Vector>;
  isSeen(point: Vector): boolean;
}

export function RulerLayer({ seen }: { readonly seen: Seen }) {
  const place = useRef<HTMLSpanElement>(null);
  const current = useRef(seen);
  current.current = seen;
  const isDrawing = tool.value === 'ruler';
  // A layout effect runs before the user can click.
  useLayoutEffect(() => {
    const pane = place.current?.closest<HTMLElement>('.pane-body');
    return isDrawing && pane ? listenToClicks(pane, (pixel) => current.current.pointAt(pixel)) : undefined;
  }, [isDrawing]);
  const first = firstEnd.value;
  return (
    <>
      <span ref={place} hidden />
      {document_.value.rulers.map((ruler, number) =>
        seen.isSeen(ruler.from) && seen.isSeen(ruler.to) ? (
          <RulerView key={`ruler ${number}`} ruler={ruler} number={number} seen={seen} />
        ) : null,
      )}
      {isDrawing && first && seen.isSeen(first) && <Dot at={seen.pixelOf(first)} />}
    </>
  );
}

function Dot({ at }: { readonly at: Pair }) {
  return <div class="ruler-dot" style={{ left: `${at[0]}px`, top: `${at[1]}px` }} />;
}

interface RulerViewProps {
  readonly ruler: Ruler;
  readonly number: number;
  readonly seen: Seen;
}

function RulerView({ ruler, number, seen }: RulerViewProps) {
  const latest = useRef(new Latest());
  const ends = { from: seen.pixelOf(ruler.from), to: seen.pixelOf(ruler.to) };
  const middle = [0, 1].map((axis) => ((ends.from[axis] ?? 0) + (ends.to[axis] ?? 0)) / 2);
  const words = mm(rulerLength(ruler), 1);
  const last = useRef<{ readonly end: End; readonly pixel: Pair } | null>(null);
  const follow = async () => {
    try {
      if (last.current) {
        const { end, pixel } = last.current;
        moveRuler(number, end, await seen.pointAt(pixel));
      }
    } catch (error) {
      recover(error);
    }
  };
  const drag = (end: End, pixel: Pair) => {
    last.current = { end, pixel };
    latest.current.run(follow);
  };
  // The end of a drag replaces a move that has not been performed yet.
  const finish = () =>
    latest.current.run(async () => {
      await follow();
      endRulerMove();
    });
  const by = (end: End, [x, y]: Pair) => drag(end, [ends[end][0] + x, ends[end][1] + y]);
  return (
    <>
      <svg class="place-lines" width="100%" height="100%" aria-hidden="true">
        <path d={`M${ends.from}L${ends.to}`} stroke={COLOR} stroke-width="1.5" />
      </svg>
      <span class="ruler-words" style={{ left: `${middle[0]}px`, top: `${middle[1]}px` }}>
        {words}
      </span>
      {(['from', 'to'] as const).map((end) => (
        <Handle
          key={end}
          at={ends[end]}
          words={`${end === 'from' ? 'start' : 'end'} of ruler ${number + 1}, ${words}, ${seen.where}`}
          color={COLOR}
          kind="ruler"
          onBegin={() => {
            last.current = null;
            beginRulerMove();
          }}
          onDrag={(pixel) => drag(end, pixel)}
          onArrow={(step) => by(end, step)}
          onEnd={finish}
          onPutBack={putRulerBack}
          onRemove={() => removeRuler(number)}
        />
      ))}
    </>
  );
}

/** Handles left clicks, but not drags. Returns a function that stops this. */
function listenToClicks(pane: HTMLElement, pointAt: (pixel: Pair) => Promise<Vector>): () => void {
  const stop = new AbortController();
  let pressed: Pair | null = null;
  const placeOf = (event: PointerEvent): Pair => {
    const box = pane.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  pane.addEventListener(
    'pointerdown',
    (event) => {
      pressed = event.button === 0 ? placeOf(event) : null;
    },
    { signal: stop.signal },
  );
  pane.addEventListener(
    'pointerup',
    (event) => {
      const [from, to] = [pressed, placeOf(event)];
      pressed = null;
      if (from && Math.hypot(to[0] - from[0], to[1] - from[1]) <= CLICK_WITHIN) {
        pointAt(to).then(setRulerPoint, recover);
      }
    },
    { signal: stop.signal },
  );
  return () => stop.abort();
}

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
