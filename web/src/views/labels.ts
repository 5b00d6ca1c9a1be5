/** Requests orientation letters and scale bar of a picture from the engine. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { LaidPicture, PictureLabels } from '../core/messages';
import { engine } from '../worker/engine';

/** Labels of a picture; until they arrive, those of the previous picture. */
export function useLabels(picture: LaidPicture): PictureLabels | null {
  const [labels, setLabels] = useState<PictureLabels | null>(null);
  const latest = useRef(new Latest());
  const isThere = useRef(true);
  const text = JSON.stringify(picture);
  useEffect(
    () => () => {
      isThere.current = false;
    },
    [],
  );
  useEffect(() => {
    latest.current.run(async () => {
      // After an error, show no labels rather than those of another view.
      const found = await engine.ask('labels', JSON.parse(text) as LaidPicture).catch(() => null);
      if (isThere.current) {
        setLabels(found);
      }
    });
  }, [text]);
  return labels;
}
