/** The letters and the scale bar of a picture, as the engine decides them. */
import { useEffect, useRef, useState } from 'preact/hooks';
import { engine } from '../client/shared';
import { Latest } from '../core/latest';
import type { LaidPicture, PictureLabels } from '../core/messages';

/** The labels of a picture; those of the one before until they are known. */
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
      // Rather none than those of another view.
      const found = await engine.ask('labels', JSON.parse(text) as LaidPicture).catch(() => null);
      if (isThere.current) {
        setLabels(found);
      }
    });
  }, [text]);
  return labels;
}
