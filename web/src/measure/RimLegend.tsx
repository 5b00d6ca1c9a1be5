/** The colours of the rim with the values at both ends, or the reason why there is no rim. */
import { useSignalEffect } from '@preact/signals';
import { useState } from 'preact/hooks';
import { Failure } from '../core/failure';
import type { Legend } from '../core/messages';
import { rimLegend } from './rim';

export function RimLegend() {
  const [legend, setLegend] = useState<Legend | string | null>(null);
  useSignalEffect(() => {
    let isWanted = true;
    rimLegend().then(
      (found) => isWanted && setLegend(found),
      (error: unknown) => isWanted && setLegend(Failure.of(error).message),
    );
    return () => {
      isWanted = false;
    };
  });
  if (!legend || typeof legend === 'string') {
    return legend && <p class="rim-legend">{legend}</p>;
  }
  const { words, unit, low, high, colours } = legend;
  const steps = colours.map((colour) => `rgb(${colour.join(' ')})`).join(', ');
  return (
    <div class="rim-legend" data-testid="rim-legend">
      <span>{words}</span>
      <span>{`${high} ${unit}`}</span>
      <i style={{ background: `linear-gradient(to top, ${steps})` }} />
      <span>{`${low} ${unit}`}</span>
    </div>
  );
}
