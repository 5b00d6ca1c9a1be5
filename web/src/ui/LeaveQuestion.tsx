/** Asks the user before unsaved work is lost. */
import { Failure } from '../core/failure';
import { saveSession } from '../output/session';
import { problem } from '../state/store';
import { leaving } from '../study/leaving';

export function LeaveQuestion() {
  const waiting = leaving.value;
  if (!waiting) {
    return null;
  }
  const stay = () => {
    leaving.value = null;
  };
  const go = () => {
    stay();
    void waiting.go();
  };
  const saveFirst = () => {
    stay();
    saveSession()
      .then(waiting.go)
      .catch((error: unknown) => {
        problem.value = Failure.of(error);
      });
  };
  return (
    <div
      class="file-question"
      role="alertdialog"
      aria-label={waiting.words}
      onKeyDown={(event) => {
        event.stopPropagation();
        if (event.key === 'Escape') {
          stay();
        }
      }}
    >
      <p>{waiting.words}</p>
      <button type="button" onClick={go}>
        Discard
      </button>
      <button type="button" onClick={saveFirst}>
        Save the session first
      </button>
      <button type="button" ref={(button) => button?.focus()} onClick={stay}>
        Go back
      </button>
    </div>
  );
}
