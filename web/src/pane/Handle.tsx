/** A handle over a picture, moved by dragging or arrow keys. */
import type { TargetedKeyboardEvent, TargetedPointerEvent } from 'preact';
import { useRef } from 'preact/hooks';
import type { Pair } from '../core/messages';

export interface HandleProps {
  /** Position in CSS pixels from the top left of the overlay. */
  readonly at: Pair;
  readonly words: string;
  readonly color: string;
  readonly kind: string;
  readonly style?: Readonly<Record<string, string>>;
  readonly isReachable?: boolean;
  onBegin?(): void;
  /** Called with the pointer position during a drag (CSS pixels from the top left of the overlay). */
  onDrag(at: Pair): void;
  /** Called by arrow keys with steps right and down: -1, 0 or 1; with Shift ten times as far. */
  onArrow?(by: Pair): void;
  onEnd(): void;
  onPutBack(): void;
  onConfirm?(): void;
  onRemove?(): void;
}

const ARROWS: Readonly<Record<string, Pair>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

function nearestHandle(x: number, y: number): Element | undefined {
  const distance = (handle: Element) => {
    const { left, right, top, bottom } = handle.getBoundingClientRect();
    return Math.hypot((left + right) / 2 - x, (top + bottom) / 2 - y);
  };
  const here = document.elementsFromPoint(x, y).filter((element) => element.matches('.overlay .handle'));
  return here.sort((a, b) => distance(a) - distance(b))[0];
}

export function Handle(props: HandleProps) {
  const isDragged = useRef(false);
  const begin = (event: TargetedPointerEvent<HTMLButtonElement>) => {
    event.stopPropagation();
    const nearest = nearestHandle(event.clientX, event.clientY);
    if (nearest && nearest !== event.currentTarget && event.isTrusted) {
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
      tabIndex={props.isReachable === false ? -1 : 0}
      style={{ ...props.style, left: `${props.at[0]}px`, top: `${props.at[1]}px`, '--color': props.color }}
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
