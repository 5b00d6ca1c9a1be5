/** Keeps the session over a reload of the tab, if the user allows it: no pixels, and only until the tab closes. */
import { effect, signal } from '@preact/signals';
import { document_, saved } from '../state/history';
import { showFailure } from '../state/message';
import { hasVolume } from '../state/store';

/** Storage keys of the session and of the permission. */
const SESSION = 'lumencut-session';
const ALLOWED = 'lumencut-keeps-session';

/** Delay after a change (ms), so that rapid changes write nothing. */
const SAVE_DELAY_MS = 1000;

export const isKeeping = signal(false);

/** A session kept before this load, until the user decides about it. */
export const kept = signal<string | null>(null);

type Kept = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

/** Stores the session after each change. Returns the function that ends it. */
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
          .catch(showFailure);
      }, SAVE_DELAY_MS);
    }
    tab[isOn ? 'setItem' : 'removeItem'](ALLOWED, 'yes');
  });
}
