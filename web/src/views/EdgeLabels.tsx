/** Letters at the edges of a view, and its scale bar. */
import type { Pair, Vector } from '../core/messages';
import { negate } from '../core/vectors';
import { states } from '../state/store';
import { barLength, lettersOf } from './letters';

interface EdgeLabelsProps {
  readonly right: Vector;
  readonly down: Vector;
  /** CSS pixels. */
  readonly size: Pair;
  /** mm per CSS pixel. */
  readonly spacing: number;
}

/** A bar takes at most this part of the width. */
const BAR_PART = 0.3;

export function EdgeLabels({ right, down, size, spacing }: EdgeLabelsProps) {
  const bar = barLength(size[0] * BAR_PART * spacing);
  const { spacing: hasLengths, orientation: hasSides } = states.value;
  return (
    <>
      {hasSides && <Sides right={right} down={down} />}
      {hasLengths && (
        <svg
          class="bar"
          width={bar / spacing + 2}
          height="22"
          role="img"
          aria-label={`scale bar of ${bar} mm`}
        >
          <path d={`M1 14v6h${bar / spacing}v-6`} />
          <text x={bar / spacing / 2 + 1} y="12" text-anchor="middle">
            {bar < 10 ? `${bar} mm` : `${bar / 10} cm`}
          </text>
        </svg>
      )}
    </>
  );
}

function Sides({ right, down }: { readonly right: Vector; readonly down: Vector }) {
  return (
    <>
      <span class="edge top">{lettersOf(negate(down))}</span>
      <span class="edge bottom">{lettersOf(down)}</span>
      <span class="edge left">{lettersOf(negate(right))}</span>
      <span class="edge right">{lettersOf(right)}</span>
    </>
  );
}
