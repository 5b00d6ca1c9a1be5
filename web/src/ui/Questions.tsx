/** Questions to the user that wait for an answer: about unsaved work, an unclear file, and a kept session. */

import { addMask } from '../edit/branches';
import { saveSession } from '../output/save-actions';
import { openList } from '../state/panels';
import { askToLeave, askWhatIs, kept, leaving, setKept, unclearFiles } from '../state/questions';
import { hasVolume, showProblem } from '../state/store';
import { openFiles } from '../study/opening';
import { openSession } from '../study/saving';
import { leave } from '../study/unsaved';
import { Question } from './Question';

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
    <Question label={waiting.words}>
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
    </Question>
  );
}

/** Asks how to use a volume that arrives while a scan is open. */
export function FileQuestion() {
  const unclear = unclearFiles.value;
  if (!unclear) {
    return null;
  }
  const { files, canBeMask } = unclear;
  const focusIf = (isFirst: boolean) => (button: HTMLButtonElement | null) => {
    if (isFirst) {
      button?.focus();
    }
  };
  const answer = (work: () => Promise<unknown>) => {
    askWhatIs(null);
    void work();
  };
  return (
    <Question label="What is this file?">
      <p>{`What is ${files.map(({ file }) => file.name).join(', ')}?`}</p>
      <button
        type="button"
        ref={focusIf(!canBeMask)}
        onClick={() => answer(() => leave(() => openFiles(files)))}
      >
        Open as a new scan
      </button>
      <button
        type="button"
        ref={focusIf(canBeMask)}
        disabled={!canBeMask}
        title={canBeMask ? undefined : 'Its grid is not that of the open scan'}
        onClick={() => answer(() => addMask(files))}
      >
        Use as a mask of vessels
      </button>
      <button type="button" onClick={() => answer(async () => undefined)}>
        Cancel
      </button>
    </Question>
  );
}

/** After a reload of the tab, asks whether to continue with the kept session. */
export function KeptQuestion() {
  const text = kept.value;
  if (text === null || !hasVolume.value) {
    return null;
  }
  const goOn = async () => {
    try {
      await openSession({ path: 'kept.mrk.json', file: new File([text], 'kept.mrk.json') });
      // Only now, because a session of another scan is rejected, and must stay kept until that scan is open.
      setKept(null);
      openList();
    } catch (error) {
      showProblem(error);
    }
  };
  const words = 'This tab kept vessels and marks from before the reload.';
  return (
    <Question label={words}>
      <p>{words}</p>
      <button type="button" ref={(button) => button?.focus()} onClick={() => void goOn()}>
        Continue with them
      </button>
      <button type="button" onClick={() => setKept(null)}>
        Discard them
      </button>
    </Question>
  );
}
