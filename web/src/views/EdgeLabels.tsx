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
  readonly hasSides?: boolean;
}

export function EdgeLabels({ right, down, size, spacing, hasSides = true }: EdgeLabelsProps) {
  const labels = useLabels({ right, down, width: size[0], pixel_spacing: spacing });
  return (
    <>
      {labels && hasSides && states.value.orientation && <Sides letters={labels.letters} />}
      {labels?.bar && hasMillimetres.value && fits(labels.bar.pixels, size[0]) && <Bar bar={labels.bar} />}
    </>
  );
}

/** Width of the bar's label and of the bar's distance from the edge (CSS pixels). */
const BAR_LABEL = 56;
const BAR_EDGE = 8;

/** Whether the bar and its label fit into a view without being cut off. */
export const fits = (bar: number, width: number): boolean => 2 * BAR_EDGE + Math.max(bar, BAR_LABEL) <= width;

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
  // The middle of a longer label would begin left of the view.
  const isShort = pixels < BAR_LABEL;
  return (
    <svg class="bar" width={pixels + 2} height="22" role="img" aria-label={`scale bar of ${words}`}>
      <path d={`M1 14v6h${pixels}v-6`} />
      <text x={isShort ? 0 : pixels / 2 + 1} y="12" text-anchor={isShort ? 'start' : 'middle'}>
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
