/** After a reload of the tab, asks whether to continue with the kept session. */
import { openList } from '../state/panels';
import { kept, setKept } from '../state/questions';
import { hasVolume, showProblem } from '../state/store';
import { openSession } from '../study/saving';

export function KeptQuestion() {
  const text = kept.value;
  if (text === null || !hasVolume.value) {
    return null;
  }
  const goOn = async () => {
    setKept(null);
    try {
      await openSession({ path: 'kept.mrk.json', file: new File([text], 'kept.mrk.json') });
      openList();
    } catch (error) {
      showProblem(error);
    }
  };
  const words = 'This tab kept unsaved vessels from before the reload.';
  return (
    <div class="file-question" role="alertdialog" aria-label={words}>
      <p>{words}</p>
      <button type="button" ref={(button) => button?.focus()} onClick={() => void goOn()}>
        Continue with them
      </button>
      <button type="button" onClick={() => setKept(null)}>
        Discard them
      </button>
    </div>
  );
}
