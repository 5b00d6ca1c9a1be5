/** Orientation letters at the edges of a view, and its scale bar. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { LaidPicture, Pair, PictureLabels, Vector } from '../core/messages';
import { hasMillimetres } from '../state/millimetres';
import { states } from '../state/store';
import { engine } from '../worker/engine';

interface EdgeLabelsProps {
  readonly right: Vector;
  readonly down: Vector;
  readonly size: Pair;
  readonly spacing: number;
}

export function EdgeLabels({ right, down, size, spacing }: EdgeLabelsProps) {
  const labels = useLabels({ right, down, width: size[0], pixel_spacing: spacing });
  const hasSides = states.value.orientation;
  return (
    <>
      {labels && hasSides && <Sides letters={labels.letters} />}
      {labels?.bar && hasMillimetres.value && <Bar bar={labels.bar} />}
    </>
  );
}

function Sides({ letters }: Pick<PictureLabels, 'letters'>) {
  return (
    <>
      <span class="edge top">{letters.top}</span>
      <span class="edge bottom">{letters.bottom}</span>
      <span class="edge left">{letters.left}</span>
      <span class="edge right">{letters.right}</span>
    </>
  );
}

function Bar({ bar: { words, pixels } }: { readonly bar: NonNullable<PictureLabels['bar']> }) {
  return (
    <svg class="bar" width={pixels + 2} height="22" role="img" aria-label={`scale bar of ${words}`}>
      <path d={`M1 14v6h${pixels}v-6`} />
      <text x={pixels / 2 + 1} y="12" text-anchor="middle">
        {words}
      </text>
    </svg>
  );
}

/** Labels of a picture; until they arrive, those of the previous picture. */
function useLabels(picture: LaidPicture): PictureLabels | null {
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
