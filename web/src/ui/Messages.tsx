/** Messages about failures, and the progress of long work. */

import { CRASH, type Failure } from '../core/failure';
import { findAndList } from '../edit/branches';
import { performAny } from '../edit/performing';
import { takeNearest } from '../edit/pointing';
import { saveSession } from '../output/save-actions';
import { editQueue } from '../state/edit-queue';
import { message, showFailure } from '../state/message';
import { closeProblem, problem, progress, started } from '../state/store';
import { isTracing } from '../state/tool';
import { Mends } from './Mends';

export function Messages() {
  return (
    <div class="messages">
      {progress.value && <Loading />}
      {editQueue.state.phase === 'stopping' && started.value?.stop === null && (
        <div class="message" role="status">
          This work runs to its end: without shared memory it cannot be stopped.
        </div>
      )}
      {problem.value && <Problem />}
      {message.value && (
        <div class="message told" role="status" data-testid="told">
          {message.value}
        </div>
      )}
    </div>
  );
}

function Loading() {
  const shown = progress.value;
  if (!shown) {
    return null;
  }
  const share = shown.total ? shown.done / shown.total : null;
  return (
    <div class="message" role="status">
      <span>{share === null ? `${shown.words} …` : `${shown.words}: ${(100 * share).toFixed(0)} %`}</span>
      <progress aria-label={shown.words} {...(share === null ? {} : { value: share })} />
      {editQueue.state.isLong && <LongWork />}
      <button type="button" onClick={() => performAny('cancel')}>
        {editQueue.state.isLong ? 'Stop' : 'Cancel'}
      </button>
    </div>
  );
}

/** Asks the user whether a long search should continue; the search runs on meanwhile. */
function LongWork() {
  return (
    <>
      <strong>This is taking long. Is the point in a vessel, not in bone?</strong>
      <button type="button" onClick={() => editQueue.goOnSearching()}>
        Continue
      </button>
    </>
  );
}

function Problem() {
  const failure = problem.value;
  if (!failure) {
    return null;
  }
  return (
    <div class="message problem" role="alert">
      <strong>{failure.subject}</strong>
      {failure.series.length > 0 ? (
        <span>{`Found ${failure.series.length} series. Which one should be opened?`}</span>
      ) : (
        <Sentences failure={failure} />
      )}
      <Mends failure={failure} />
      <Bridging failure={failure} />
      <Nearest failure={failure} />
      {failure.isMendedBy('doubtful') && <DoubtfulOnes />}
      {failure.kind === CRASH && (
        <button type="button" onClick={() => void saveSession().catch(showFailure)}>
          Save the session
        </button>
      )}
      <button type="button" onClick={closeProblem}>
        Close
      </button>
    </div>
  );
}

/** Buttons shown if no lumen was found between two clicks. */
function Bridging({ failure }: { readonly failure: Failure }) {
  const bridge = editQueue.state.refusal?.failure === failure ? editQueue.state.refusal.bridge : null;
  return bridge ? (
    <>
      <button type="button" onClick={bridge}>
        Bridge the gap
      </button>
      <button type="button" onClick={closeProblem}>
        Add a point between
      </button>
    </>
  ) : null;
}

/** Button that takes the nearest place that looks like lumen, in place of a rejected click. */
function Nearest({ failure: { nearest } }: { readonly failure: Failure }) {
  return nearest && isTracing() ? (
    <button type="button" onClick={() => takeNearest(nearest)}>
      Take the nearest place
    </button>
  ) : null;
}

/** Button shown if all vessels that were found are doubtful. */
function DoubtfulOnes() {
  return (
    <button type="button" onClick={() => void findAndList(true)}>
      Show the doubtful vessels
    </button>
  );
}

function Sentences({ failure }: { readonly failure: Failure }) {
  const { found, expected, mending } = failure;
  return (
    <>
      <span>{`Found ${found}; expected ${expected}.`}</span>
      {mending && <span>{`${mending[0]?.toUpperCase() ?? ''}${mending.slice(1)}.`}</span>}
    </>
  );
}
