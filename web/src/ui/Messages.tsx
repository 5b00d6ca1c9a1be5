/** What went wrong, and how far long work is. */
import { engine } from '../core/shared';
import { perform } from '../state/actions';
import { problem, progress } from '../state/store';
import { Mends } from './Mends';

export function Messages() {
  return (
    <div class="messages">
      {progress.value && <Loading />}
      {problem.value && <Problem />}
    </div>
  );
}

function Loading() {
  const told = progress.value;
  if (!told) {
    return null;
  }
  const share = told.total ? told.done / told.total : null;
  return (
    <div class="message" role="status">
      <span>{share === null ? `${told.words} …` : `${told.words}: ${(100 * share).toFixed(0)} %`}</span>
      <progress aria-label={told.words} {...(share === null ? {} : { value: share })} />
      <button type="button" onClick={() => perform(engine, 'cancel')}>
        Cancel
      </button>
    </div>
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
      <span>{`Found ${failure.found}; expected ${failure.expected}.`}</span>
      {failure.mend && <span>{`${failure.mend[0]?.toUpperCase() ?? ''}${failure.mend.slice(1)}.`}</span>}
      <Mends failure={failure} />
      <button
        type="button"
        onClick={() => {
          problem.value = null;
        }}
      >
        Close
      </button>
    </div>
  );
}
