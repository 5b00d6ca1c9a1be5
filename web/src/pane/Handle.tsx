/** A place over a picture that can be dragged with the pointer, and moved with the arrow keys while it has the focus. */
import type { TargetedKeyboardEvent, TargetedPointerEvent } from 'preact';
import { useRef } from 'preact/hooks';
import type { Pair } from '../core/messages';

export interface HandleProps {
  /** CSS pixels from the top left of the overlay. */
  readonly at: Pair;
  /** What it is, for screen readers and on hover. */
  readonly words: string;
  readonly color: string;
  /** A look of its own in the style sheet: `handle ${kind}`. */
  readonly kind: string;
  onBegin?(): void;
  /** Where the pointer is now, in pixels of the overlay. */
  onDrag(at: Pair): void;
  /** An arrow key: -1, 0 or 1 to the right and downwards; ten times as far with Shift. */
  onArrow?(by: Pair): void;
  /** The end of a drag, or of a move by a key. */
  onEnd(): void;
  /** Escape while it is dragged: it goes back. */
  onPutBack(): void;
  /** Enter. */
  onConfirm?(): void;
  /** Right click, Delete or Backspace. */
  onRemove?(): void;
}

const ARROWS: Readonly<Record<string, Pair>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** The handle whose middle is nearest, of those whose zones hold a point of the window. */
function nearestHandle(x: number, y: number): Element | undefined {
  const away = (handle: Element) => {
    const { left, right, top, bottom } = handle.getBoundingClientRect();
    return Math.hypot((left + right) / 2 - x, (top + bottom) / 2 - y);
  };
  const here = document.elementsFromPoint(x, y).filter((element) => element.matches('.overlay .handle'));
  return here.sort((a, b) => away(a) - away(b))[0];
}

export function Handle(props: HandleProps) {
  const isDragged = useRef(false);
  const begin = (event: TargetedPointerEvent<HTMLButtonElement>) => {
    event.stopPropagation();
    const nearest = nearestHandle(event.clientX, event.clientY);
    if (nearest && nearest !== event.currentTarget && event.isTrusted) {
      // Zones overlap: of two grips the one that is nearer is meant.
      nearest.dispatchEvent(new PointerEvent('pointerdown', event));
    } else if (event.button === 0) {
      event.currentTarget.setPointerCapture(event.pointerId);
      isDragged.current = true;
      props.onBegin?.();
    }
  };
  const move = (event: TargetedPointerEvent<HTMLButtonElement>) => {
    event.stopPropagation();
    const overlay = event.currentTarget.parentElement;
    if (isDragged.current && overlay) {
      const box = overlay.getBoundingClientRect();
      props.onDrag([event.clientX - box.left, event.clientY - box.top]);
    }
  };
  const end = (event: TargetedPointerEvent<HTMLButtonElement>) => {
    event.stopPropagation();
    if (isDragged.current) {
      isDragged.current = false;
      props.onEnd();
    }
  };
  const pressed = (event: TargetedKeyboardEvent<HTMLButtonElement>) => {
    const arrow = ARROWS[event.key];
    if (event.key === 'Escape' && isDragged.current) {
      isDragged.current = false;
      props.onPutBack();
    } else if (arrow && props.onArrow) {
      const far = event.shiftKey ? 10 : 1;
      props.onBegin?.();
      props.onArrow([arrow[0] * far, arrow[1] * far]);
      props.onEnd();
    } else if (event.key === 'Enter' && props.onConfirm) {
      props.onConfirm();
    } else if ((event.key === 'Delete' || event.key === 'Backspace') && props.onRemove) {
      props.onRemove();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <button
      type="button"
      class={`handle ${props.kind}`}
      style={{ left: `${props.at[0]}px`, top: `${props.at[1]}px`, '--color': props.color }}
      aria-label={props.words}
      title={props.words}
      onPointerDown={begin}
      onPointerMove={move}
      onPointerUp={end}
      onPointerCancel={end}
      onKeyDown={pressed}
      onContextMenu={(event) => {
        event.preventDefault();
        event.stopPropagation();
        props.onRemove?.();
      }}
    />
  );
}
