/** A picture that the engine makes, on a canvas of its own: slices, the straightened vessel, the section. */
import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import type { Pair, Picture } from '../core/messages';
import { type Handlers, listen } from '../input/pointer';
import { recover } from '../state/device';
import { isInverted, type ViewName } from '../state/store';
import { Latest } from './latest';
import { usePaneSize } from './pane-size';

interface FlatPictureProps {
  readonly name: ViewName;
  /** What a screen reader says of it. */
  readonly words: string;
  /** Gives the picture for a pane; it changes whenever the picture does. */
  readonly ask: ((size: Pair) => Promise<Picture>) | null;
  readonly handlers: Handlers;
  /** How large a pixel of the picture is on the screen, and whether it fills the pane. */
  readonly style?: Record<string, string>;
  readonly onSize?: (size: Pair) => void;
  readonly children?: ComponentChildren;
}

export function FlatPicture({ name, words, ask, handlers, style, onSize, children }: FlatPictureProps) {
  const pane = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const latest = useRef(new Latest());
  const current = useRef(handlers);
  current.current = handlers;
  const size = usePaneSize(pane);

  useEffect(() => {
    if (size) {
      onSize?.(size);
    }
  }, [size]);

  useEffect(() => {
    if (!ask || !size || size[0] < 2 || size[1] < 2) {
      return;
    }
    latest.current.run(async () => {
      try {
        paint(canvas.current, await ask(size));
      } catch (error) {
        recover(error);
      }
    });
  }, [ask, size]);

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

  return (
    <div
      class="pane-body"
      ref={pane}
      data-testid={name}
      role="img"
      aria-label={words}
      tabIndex={0}
      onKeyDown={(event) => pressed(event, handlers)}
    >
      <canvas ref={canvas} class={isInverted.value ? 'flat inverted' : 'flat'} style={style} />
      <div class="overlay">{children}</div>
    </div>
  );
}

/** Arrow keys scroll, + and - zoom. */
function pressed(event: KeyboardEvent, handlers: Handlers): void {
  const steps = { ArrowDown: 1, PageDown: 10, ArrowUp: -1, PageUp: -10 }[event.key];
  const factor = { '+': 1.2, '-': 1 / 1.2 }[event.key];
  if (steps) {
    event.preventDefault();
    handlers.scroll(steps);
  } else if (factor) {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    handlers.zoom(factor, [box.width / 2, box.height / 2]);
  }
}

/** Handlers that always are the latest ones. */
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
  };
}

function paint(canvas: HTMLCanvasElement | null, { size, bytes }: Picture): void {
  if (!canvas) {
    return;
  }
  [canvas.width, canvas.height] = size;
  canvas.getContext('2d')?.putImageData(new ImageData(bytes, size[0], size[1]), 0, 0);
  canvas.dataset.shown = String(Number(canvas.dataset.shown ?? 0) + 1);
}
