/** Doubts about the line of a shown vessel, one at a time, with buttons that show its place and cut there. */

import { useSignal } from '@preact/signals';
import type { DoubtfulPlace } from '../core/messages';
import { cut } from '../edit/vessels';
import { goToVessel } from '../state/shown';

interface LineDoubtsProps {
  readonly id: number;
  readonly words: string;
  readonly doubts: readonly DoubtfulPlace[];
}

export function LineDoubts({ id, words, doubts }: LineDoubtsProps) {
  const number = useSignal(0);
  const doubt = doubts[number.value];
  const at = doubt?.at ?? null;
  return (
    <>
      <span>{doubt ? `${words} ${doubt.words}` : words}</span>
      {at !== null && (
        <>
          <button type="button" onClick={() => goToVessel(id, at)}>
            Go there
          </button>
          <button type="button" onClick={() => void cut(id, at)}>
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
