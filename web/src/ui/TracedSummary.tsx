/** Summary of the vessel traced last: its length, its connections, and its doubts with buttons. */

import { useSignal } from '@preact/signals';
import type { Told } from '../core/messages';
import { cut } from '../edit/vessels';
import { moveTo } from '../state/cross-hair';
import { tracedSummary } from '../state/drawing';
import { tree } from '../state/shown';
import { pickVessel } from '../state/store';

export function TracedSummary() {
  return tracedSummary.value && <Summary key={tracedSummary.value.words} summary={tracedSummary.value} />;
}

/** Shows one doubt at a time, since the bar has only two lines. */
function Summary({ summary: { vessel, words, doubts } }: { readonly summary: Told }) {
  const number = useSignal(0);
  const doubt = doubts[number.value];
  const at = doubt?.at ?? null;
  return (
    <>
      <span>{doubt ? `${words} ${doubt.words}` : words}</span>
      {at !== null && (
        <>
          <button type="button" onClick={() => goTo(vessel, at)}>
            Go there
          </button>
          <button type="button" onClick={() => void cut(vessel, at)}>
            Cut there
          </button>
        </>
      )}
      {doubts.length > 1 && (
        <button
          type="button"
          title="Shows the next doubt about this vessel"
          onClick={() => {
            number.value = (number.value + 1) % doubts.length;
          }}
        >
          Next doubt ({number.value + 1} of {doubts.length})
        </button>
      )}
    </>
  );
}

function goTo(vessel: number, at: number): void {
  const place = tree.value.findIndex(({ id }) => id === vessel);
  if (place >= 0) {
    pickVessel(place);
    moveTo(at);
  }
}
