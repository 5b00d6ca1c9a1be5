/** Asks the user before unsaved work is lost. */

import { saveSession } from '../output/session';
import { askToLeave, leaving } from '../state/questions';
import { showProblem } from '../state/store';

export function LeaveQuestion() {
  const waiting = leaving.value;
  if (!waiting) {
    return null;
  }
  const stay = () => askToLeave(null);
  const go = () => {
    stay();
    void waiting.go();
  };
  const saveFirst = () => {
    stay();
    saveSession().then(waiting.go).catch(showProblem);
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
