/** Letters and scale bar, as decided by the engine. */
import { useEffect, useRef, useState } from 'preact/hooks';
import { engine } from '../client/shared';
import { Latest } from '../core/latest';
import type { LaidPicture, PictureLabels } from '../core/messages';

/** Labels of a picture; the previous ones until they arrive. */
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
      // No labels rather than those of another view.
      const found = await engine.ask('labels', JSON.parse(text) as LaidPicture).catch(() => null);
      if (isThere.current) {
        setLabels(found);
      }
    });
  }, [text]);
  return labels;
}
