/** Asks how to use a volume that arrives while a scan is open. */

import { addMask } from '../edit/branches';
import { askWhatIs, unclearFiles } from '../state/questions';
import { leave } from '../study/leaving';
import { openFiles } from '../study/opening';

export function FileQuestion() {
  const files = unclearFiles.value;
  if (!files) {
    return null;
  }
  const answer = (work: () => Promise<unknown>) => {
    askWhatIs(null);
    void work();
  };
  return (
    <div class="file-question" role="alertdialog" aria-label="What is this file?">
      <p>{`What is ${files.map(({ file }) => file.name).join(', ')}?`}</p>
      <button type="button" onClick={() => answer(() => leave(() => openFiles(files)))}>
        Open as a new scan
      </button>
      <button type="button" ref={(button) => button?.focus()} onClick={() => answer(() => addMask(files))}>
        Use as a mask of vessels
      </button>
      <button type="button" onClick={() => answer(async () => undefined)}>
        Neither
      </button>
    </div>
  );
}
