/** Size of a pane, rounded to CSS pixels; null before its first layout. A hidden pane keeps its last size. */
import type { RefObject } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import type { Pair } from '../core/messages';

export function usePaneSize(pane: RefObject<HTMLElement | null>): Pair | null {
  const [size, setSize] = useState<Pair | null>(null);
  useEffect(() => {
    const element = pane.current;
    if (!element) {
      return undefined;
    }
    const observer = new ResizeObserver(() => {
      const [width, height] = [Math.floor(element.clientWidth), Math.floor(element.clientHeight)];
      if (width === 0 || height === 0) {
        return;
      }
      setSize((before) => (before && before[0] === width && before[1] === height ? before : [width, height]));
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, [pane]);
  return size;
}
