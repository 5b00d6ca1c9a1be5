/** What changed between two scans: sentences, and the diameters of both with their difference along the vessel. */
import type { TargetedPointerEvent } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { compareVessels, drawComparison } from '../compare/comparing';
import { GESTURES } from '../core/generated/tables';
import { arrowOf } from '../input/keys';
import { pixelAt, valueAt } from '../measure/layout';
import { usePaneSize } from '../pane/pane-size';
import { moveTo } from '../state/cross-hair';
import { crossHair, pickVessel, report, showProblem } from '../state/store';
import { atAcross, comparison, comparisonFailure, type VesselComparison } from '../state/two-scans';

export function ComparisonPane() {
  const [found, failure] = [comparison.value, comparisonFailure.value];
  if (failure) {
    return (
      <div class="comparison-refused" role="alert">
        <span>{`${failure.message}.`}</span>
        {failure.isMendedBy('other_patient') && (
          <button type="button" onClick={() => void compareVessels(true)}>
            Compare them anyway
          </button>
        )}
      </div>
    );
  }
  return found && <Compared found={found} />;
}

interface ComparedProps {
  readonly found: VesselComparison;
}

function Compared({ found }: ComparedProps) {
  const [vessel, before, after] = [found.asked.vessel, ...found.asked.scans];
  return (
    <section class="comparison" aria-label="Comparison of the vessel">
      <div class="comparison-words">
        <h2>{vessel}</h2>
        <p>{`Before: ${before}. After: ${after}.`}</p>
        <ul data-testid="comparison-sentences">
          {found.answer.sentences.map((words) => (
            <li key={words}>{words}</li>
          ))}
        </ul>
      </div>
      <Chart found={found} />
    </section>
  );
}

function Chart({ found }: ComparedProps) {
  const { chart, axis, sentences } = found.answer;
  const pane = useRef<HTMLDivElement>(null);
  const size = usePaneSize(pane);
  useEffect(() => {
    if (size) {
      drawComparison(found, size).catch(showProblem);
    }
  }, [size, found.asked]);
  const at = placeOnEarlier(found);
  const point = ({ currentTarget, clientX }: TargetedPointerEvent<HTMLDivElement>) =>
    moveToEarlier(found, valueAt(axis, clientX - currentTarget.getBoundingClientRect().left));
  const step = (by: number) =>
    moveToEarlier(found, Math.min(Math.max((at ?? axis.low) + by, axis.low), axis.high));
  return (
    <div
      class="comparison-chart"
      ref={pane}
      role="slider"
      tabIndex={0}
      aria-label="Place on the earlier vessel (mm)"
      aria-valuemin={axis.low}
      aria-valuemax={axis.high}
      aria-valuenow={at ?? axis.low}
      onPointerDown={point}
      onPointerMove={(event) => event.buttons === 1 && point(event)}
      onKeyDown={(event) => {
        const by = arrowOf(event.key)?.[0];
        if (by) {
          event.preventDefault();
          step(by * (event.shiftKey ? GESTURES.far_steps : 1));
        }
      }}
    >
      <img
        alt={sentences.join('. ')}
        src={`data:image/svg+xml,${encodeURIComponent(chart)}`}
        draggable={false}
      />
      {at !== null && <span class="comparison-place" style={{ left: `${pixelAt(axis, at)}px` }} />}
    </div>
  );
}

/** The arc length of the cross-hair on the earlier vessel (mm); null if it is not on the compared vessel. */
function placeOnEarlier({ lines, isOtherEarlier }: VesselComparison): number | null {
  const hair = crossHair.value;
  const line = report.value?.vessels?.[hair?.vessel ?? -1]?.line;
  if (!hair || hair.arcLength === null || line !== lines[0]) {
    return null;
  }
  return isOtherEarlier ? atAcross(hair.arcLength, false) : hair.arcLength;
}

/** Moves the cross-hair of this scan to a place on the earlier vessel; the other one follows if it is linked. */
function moveToEarlier({ lines, isOtherEarlier }: VesselComparison, place: number): void {
  const at = isOtherEarlier ? atAcross(place, true) : place;
  const vessel = report.value?.vessels?.findIndex(({ line }) => line === lines[0]) ?? -1;
  if (at !== null && vessel >= 0) {
    pickVessel(vessel, at);
    moveTo(at);
  }
}
