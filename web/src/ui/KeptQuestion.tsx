/** After a reload of the tab, asks whether to continue with the kept session. */
import { Failure } from '../core/failure';
import { openList } from '../edit/list-open';
import { hasVolume, problem } from '../state/store';
import { kept } from '../study/keeping';
import { openSession } from '../study/saving';

export function KeptQuestion() {
  const text = kept.value;
  if (text === null || !hasVolume.value) {
    return null;
  }
  const goOn = async () => {
    kept.value = null;
    try {
      await openSession({ path: 'kept.mrk.json', file: new File([text], 'kept.mrk.json') });
      openList();
    } catch (error) {
      problem.value = Failure.of(error);
    }
  };
  const words = 'This tab kept unsaved vessels from before the reload.';
  return (
    <div class="file-question" role="alertdialog" aria-label={words}>
      <p>{words}</p>
      <button type="button" ref={(button) => button?.focus()} onClick={() => void goOn()}>
        Continue with them
      </button>
      <button
        type="button"
        onClick={() => {
          kept.value = null;
        }}
      >
        Discard them
      </button>
    </div>
  );
}
