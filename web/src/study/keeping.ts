/** If the user allows it, keeps the session, without pixels, while the tab is reloaded; closing the tab deletes it. */
import { effect } from '@preact/signals';
import { document_, saved } from '../state/history';
import { showFailure } from '../state/message';
import { isKeeping, kept, setKeeping, setKept } from '../state/questions';
import { hasVolume } from '../state/store';

/** Keys in the session storage: the session, and the permission to keep it. */
const SESSION = 'lumencut-session';
const ALLOWED = 'lumencut-keeps-session';

/** The session is written this long after the last change (ms). */
const SAVE_DELAY_MS = 1000;

type Kept = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

/** Stores the session after each change. Returns a function that stops this. */
export function followKeeping(tab: Kept, write: () => Promise<string>): () => void {
  setKeeping(tab.getItem(ALLOWED) !== null);
  setKept(tab.getItem(SESSION));
  let timer: ReturnType<typeof setTimeout> | undefined;
  return effect(() => {
    const isOn = isKeeping.value;
    const isUnsaved = hasVolume.value && document_.value !== saved.value;
    clearTimeout(timer);
    if (kept.value !== null) {
      return;
    }
    if (!(isOn && isUnsaved)) {
      tab.removeItem(SESSION);
    } else {
      timer = setTimeout(() => {
        write()
          .then((text) => tab.setItem(SESSION, text))
          .catch(showFailure);
      }, SAVE_DELAY_MS);
    }
    tab[isOn ? 'setItem' : 'removeItem'](ALLOWED, 'yes');
  });
}
