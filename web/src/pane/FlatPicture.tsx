/** A canvas with a picture from the engine: slice, straightened vessel or section. */
import type { ComponentChildren } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import { GESTURES } from '../core/generated/tables';
import type { Pair, Picture } from '../core/messages';
import { arrowOf, scrollOfKey, zoomOfKey } from '../input/keys';
import { type Handlers, listen } from '../input/pointer';
import { recover } from '../state/device';
import { isInverted, type ViewName } from '../state/store';
import { usePaneSize } from './pane-size';
import { PictureRequests } from './picture-requests';

interface FlatPictureProps {
  readonly name: ViewName;
  readonly words: string;
  /** Renders the picture. A new function means that the picture has changed. */
  readonly ask: ((size: Pair) => Promise<Picture>) | null;
  readonly handlers: Handlers;
  readonly empty?: string;
  readonly style?: Record<string, string>;
  /** What the page states about the picture. A picture with another label disappears while the new one is computed. */
  readonly label?: string;
  /** Whether the displayed picture is outdated. */
  readonly isLate?: boolean;
  readonly onSize?: (size: Pair) => void;
  /** Called by arrow keys in place of scrolling, with steps right and down: 1, or 10 with Shift. */
  readonly onArrow?: ((by: Pair) => void) | undefined;
  /** Called by the keys to the left and right, unless `onArrow` is, with steps: -1 or 1, or 10 with Shift. */
  readonly onTurn?: ((steps: number) => void) | undefined;
  readonly children?: ComponentChildren;
}

export function FlatPicture({
  name,
  words,
  ask,
  handlers,
  empty,
  style,
  label = '',
  isLate,
  onSize,
  onArrow,
  onTurn,
  children,
}: FlatPictureProps) {
  const pane = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const current = useRef(handlers);
  current.current = handlers;
  const size = usePaneSize(pane);
  const [isPending, setPending] = useState(false);
  const [shown, setShown] = useState(label);
  const requests = useRef<PictureRequests>(null);
  requests.current ??= new PictureRequests({
    show: (picture, its) => {
      paint(canvas.current, picture);
      setShown(its);
    },
    rest: () => setPending(false),
    fail: recover,
  });

  useEffect(() => () => requests.current?.want(null), []);

  useEffect(() => {
    if (size) {
      onSize?.(size);
    }
  }, [size]);

  useEffect(() => {
    if (!ask) {
      clear(canvas.current);
    }
    const isAsked = ask !== null && size !== null && size[0] >= 2 && size[1] >= 2;
    setPending(isAsked);
    requests.current?.want(isAsked ? { ask, size, label } : null);
  }, [ask, size, label]);

  useEffect(() => {
    const element = pane.current;
    return element
      ? listen(
          element,
          'flat',
          forwarded(() => current.current),
        )
      : undefined;
  }, []);

  const isOutdated = isLate || shown !== label;
  return (
    <div
      class="pane-body"
      ref={pane}
      data-testid={name}
      // With role="img", screen readers would skip the handles inside.
      role="application"
      aria-label={words}
      tabIndex={0}
      onKeyDown={(event) => pressed(event, handlers, { onArrow, onTurn })}
    >
      <canvas
        ref={canvas}
        class={`flat${isInverted.value ? ' inverted' : ''}${isOutdated ? ' late' : ''}`}
        style={style}
      />
      <div class="overlay">
        {!ask && empty && <p class="nothing-yet">{empty}</p>}
        {children}
        {(isPending || isLate) && <span class="busy">Computing …</span>}
      </div>
    </div>
  );
}

/** Arrow keys scroll, turn or move the cross-hair; + and - zoom. Focused children handle their own keys. */
function pressed(
  event: KeyboardEvent,
  handlers: Handlers,
  { onArrow, onTurn }: Pick<FlatPictureProps, 'onArrow' | 'onTurn'>,
): void {
  if (event.target !== event.currentTarget) {
    return;
  }
  const arrow = arrowOf(event.key);
  const far = event.shiftKey ? GESTURES.far_steps : 1;
  if (arrow && onArrow) {
    event.preventDefault();
    onArrow([arrow[0] * far, arrow[1] * far]);
    return;
  }
  if (arrow?.[0] && onTurn) {
    event.preventDefault();
    onTurn(arrow[0] * far);
    return;
  }
  const steps = scrollOfKey(event.key, onArrow && !event.shiftKey ? 1 : GESTURES.far_steps);
  const factor = zoomOfKey(event.key);
  if (steps) {
    event.preventDefault();
    handlers.scroll(steps);
    onArrow?.([0, 0]);
  } else if (factor) {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    handlers.zoom(factor, [box.width / 2, box.height / 2]);
  }
}

function forwarded(handlers: () => Handlers): Handlers {
  return {
    drag: (...given) => handlers().drag(...given),
    zoom: (...given) => handlers().zoom(...given),
    scroll: (...given) => handlers().scroll(...given),
    click: (...given) => handlers().click(...given),
    hover: (...given) => handlers().hover(...given),
    begin: () => handlers().begin(),
    end: () => handlers().end(),
    putBack: () => handlers().putBack(),
    rows: () => handlers().rows?.() ?? null,
    step: (by) => handlers().step?.(by),
    leave: () => handlers().leave?.(),
  };
}

function clear(canvas: HTMLCanvasElement | null): void {
  canvas?.getContext('2d')?.clearRect(0, 0, canvas.width, canvas.height);
}

function paint(canvas: HTMLCanvasElement | null, { size, bytes }: Picture): void {
  if (!canvas) {
    return;
  }
  [canvas.width, canvas.height] = size;
  canvas.getContext('2d')?.putImageData(new ImageData(bytes, size[0], size[1]), 0, 0);
  canvas.dataset.shown = String(Number(canvas.dataset.shown ?? 0) + 1);
}
