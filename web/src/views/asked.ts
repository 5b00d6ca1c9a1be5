/** Requests of flat views. */
import { useCallback } from 'preact/hooks';
import { engine } from '../client/shared';
import type { Picture, Plane, Window } from '../core/messages';

/** Stable callback that changes only with the picture; null without a plane. */
export function useAsked(plane: Plane | null, window: Window): (() => Promise<Picture>) | null {
  const text = plane && JSON.stringify(plane);
  const ask = useCallback(
    () => engine.ask('slice', { plane: JSON.parse(text ?? '{}') as Plane, window }),
    [text, window],
  );
  return text ? ask : null;
}
