/** Shown in place of a diameter profile that is missing or cannot be measured. */
import type { Pair } from '../core/messages';
import { beingMeasured, measureAgain, stopped } from '../state/profiles';
import * as store from '../state/store';
import { currentFailure } from './current';

export function NoProfile({ size }: { readonly size: Pair }) {
  return (
    <div class="no-profile" style={{ height: `${size[1]}px` }} role="status" data-testid="no-profile">
      <Why />
    </div>
  );
}

function Why() {
  const failure = currentFailure.value;
  const progress = store.progress.value;
  if (failure) {
    return (
      <p>
        <strong>This vessel cannot be measured.</strong>{' '}
        {`${failure.subject}: found ${failure.found}; expected ${failure.expected}.`}
        {failure.mending && ` ${failure.mending[0]?.toUpperCase()}${failure.mending.slice(1)}.`}
      </p>
    );
  }
  if (!store.hasVolume.value) {
    return <p>Open a scan first.</p>;
  }
  if (beingMeasured.value !== null) {
    const share = progress?.total ? ` ${((100 * progress.done) / progress.total).toFixed(0)} %` : '';
    return <p>{`Measuring…${share} Press Escape to stop.`}</p>;
  }
  return stopped.value === null ? null : (
    <p>
      Measuring was stopped.{' '}
      <button type="button" onClick={measureAgain}>
        Measure it
      </button>
    </p>
  );
}
