/**
 * The session kept over a reload of the tab, where the reader allows it: vessels, marks and views as a session file has them, and no
 * pixels. It stays on the machine, and goes with the tab.
 */
import { effect, signal } from '@preact/signals';
import { document_, saved } from '../state/history';
import { hasVolume } from '../state/store';
import { tellFailure } from '../state/telling';

/** Where the tab holds the session, and that the reader allowed it. */
const SESSION = 'lumencut-session';
const ALLOWED = 'lumencut-keeps-session';

/** A change is kept so long (ms) after it came: while much is changed nothing is written. */
const AFTER = 1000;

/** Whether the reader allowed it. */
export const isKeeping = signal(false);

/** What was kept before the page was loaded, as long as the reader did not say what becomes of it. */
export const kept = signal<string | null>(null);

type Kept = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

/** Keeps the session, as `write` gives it, after each change from now on; gives what ends it. */
export function followKeeping(tab: Kept, write: () => Promise<string>): () => void {
  isKeeping.value = tab.getItem(ALLOWED) !== null;
  kept.value = tab.getItem(SESSION);
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
          .catch(tellFailure);
      }, AFTER);
    }
    tab[isOn ? 'setItem' : 'removeItem'](ALLOWED, 'yes');
  });
}
