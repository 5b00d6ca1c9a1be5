/** Orientation letters at the edges of a view, and its scale bar. */
import type { Pair, PictureLabels, Vector } from '../core/messages';
import { hasMillimetres } from '../state/millimetres';
import { states } from '../state/store';
import { useLabels } from './labels';

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
