/** Requests for the pictures of slices and sections. */
import { useCallback } from 'preact/hooks';
import type { Picture, Plane, Window } from '../core/messages';
import { engine } from '../worker/engine';

/** A function that requests the picture. It stays the same while the picture does; null without a plane. */
export function useAsked(plane: Plane | null, window: Window): (() => Promise<Picture>) | null {
  const text = plane && JSON.stringify(plane);
  const ask = useCallback(
    () => engine.ask('slice', { plane: JSON.parse(text ?? '{}') as Plane, window }),
    [text, window],
  );
  return text ? ask : null;
}
