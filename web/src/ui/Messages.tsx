/** What went wrong, and how far long work is. */
import type { Failure } from '../core/failure';
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
      {failure.series.length > 0 ? (
        <span>{`Found ${failure.series.length} series. Which of them is to be read?`}</span>
      ) : (
        <Sentences failure={failure} />
      )}
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

function Sentences({ failure }: { readonly failure: Failure }) {
  const { found, expected, mend } = failure;
  return (
    <>
      <span>{`Found ${found}; expected ${expected}.`}</span>
      {mend && <span>{`${mend[0]?.toUpperCase() ?? ''}${mend.slice(1)}.`}</span>}
    </>
  );
}
