/** What went wrong, what was odd about a file, and how far loading is. */
import { engine } from '../core/shared';
import { notes, problem, progress } from '../state/store';

export function Messages() {
  return (
    <div class="messages">
      {progress.value && <Loading />}
      {problem.value && <Problem />}
      {notes.value.length > 0 && (
        <details class="notes">
          <summary>{notes.value.length === 1 ? '1 note' : `${notes.value.length} notes`} on this scan</summary>
          <ul>
            {notes.value.map((note) => (
              <li key={note}>{note}</li>
            ))}
          </ul>
        </details>
      )}
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
      <button type="button" onClick={() => void engine.cancel()}>
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
