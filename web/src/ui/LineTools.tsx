/** Changes the picked vessel's line by hand: its grips in slices and section, and a slider that smooths it. */
import { useEffect, useState } from 'preact/hooks';
import type { DocumentVessel } from '../core/messages';
import { forgetLinePreview, previewLine, reshapeLine } from '../edit/reshaping';
import { contents } from '../state/lines';
import { hasMillimetres } from '../state/millimetres';
import { isReshaping, showLineGrips } from '../state/reshaping';

const SMOOTHEST_MM = 20;

interface LineProps {
  readonly vessel: DocumentVessel;
}

export function LineTools({ vessel }: LineProps) {
  const isShown = isReshaping.value;
  useEffect(() => () => void showLineGrips(false), [vessel.id]);
  return (
    <>
      <button
        type="button"
        aria-pressed={isShown}
        title="Shows grips on the line in slices and section. A drag moves the line; it then counts as drawn by hand"
        onClick={() => showLineGrips(!isShown)}
      >
        Edit line
      </button>
      {isShown && <Smoothing vessel={vessel} />}
    </>
  );
}

function Smoothing({ vessel }: LineProps) {
  const [sigma, setSigma] = useState(0);
  return (
    <label
      class="smoothing"
      title="Averages the line by a Gaussian with this standard deviation; its ends stay"
    >
      <span>Smooth</span>
      <input
        type="range"
        min="0"
        max={SMOOTHEST_MM}
        step="0.5"
        value={sigma}
        onInput={(event) => {
          const wanted = Number(event.currentTarget.value);
          setSigma(wanted);
          if (wanted > 0) {
            previewLine(vessel.line, { kind: 'smooth', sigma: wanted });
          } else {
            forgetLinePreview();
          }
        }}
        onChange={() => void reshapeLine(vessel.id).then(() => setSigma(0))}
      />
      <output>{`${sigma}${hasMillimetres.value ? ' mm' : ''}`}</output>
    </label>
  );
}

export const LineByHand = ({ vessel }: LineProps) =>
  contents.value.get(vessel.line)?.by_hand ? (
    <small title="The reader moved or smoothed this line">line by hand</small>
  ) : null;
