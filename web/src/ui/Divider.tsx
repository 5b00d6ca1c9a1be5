/** Divider between panes, moved by dragging or arrow keys. */
import type { Signal } from '@preact/signals';
import { moveDivider } from '../state/panels';

interface DividerProps {
  readonly words: string;
  /** `column` separates panes that are side by side, `row` those one above the other. */
  readonly between: 'column' | 'row';
  /** Position as a share of the width or height of the layout. */
  readonly place: Signal<number>;
}

export function Divider({ words, between, place }: DividerProps) {
  const set = (value: number) => moveDivider(place, value);
  const move = (event: PointerEvent) => {
    const layout = (event.currentTarget as HTMLElement).parentElement;
    if (layout && (event.currentTarget as HTMLElement).hasPointerCapture(event.pointerId)) {
      const box = layout.getBoundingClientRect();
      set(
        between === 'column'
          ? (event.clientX - box.left) / box.width
          : (event.clientY - box.top) / box.height,
      );
    }
  };
  const key = (event: KeyboardEvent) => {
    const step = { ArrowLeft: -0.02, ArrowUp: -0.02, ArrowRight: 0.02, ArrowDown: 0.02 }[event.key];
    if (step) {
      event.preventDefault();
      set(place.value + step);
    }
  };
  const at = `${100 * place.value}%`;
  return (
    // biome-ignore lint/a11y/useSemanticElements: an hr element cannot be moved by the user
    <div
      class={`divider ${between}`}
      style={between === 'column' ? { left: `var(--left, ${at})` } : { top: at }}
      role="separator"
      tabIndex={0}
      aria-label={words}
      aria-orientation={between === 'column' ? 'vertical' : 'horizontal'}
      aria-valuenow={Math.round(100 * place.value)}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={move}
      onKeyDown={key}
    />
  );
}
