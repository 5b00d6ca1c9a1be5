/** Protects unsaved work: asks before it is lost, and keeps the session during a reload if the user allows it. */
import { effect } from '@preact/signals';
import type { Document } from '../state/document';
import { document_, given, saved } from '../state/history';
import { showFailure } from '../state/message';
import { askToLeave, isKeeping, kept, setKeeping, setKept } from '../state/questions';
import { hasVolume } from '../state/store';

/** Keys in the session storage: the session, and the permission to keep it. */
const SESSION = 'lumencut-session';
const ALLOWED = 'lumencut-keeps-session';

/** The session is written this long after the last change (ms). */
const SAVE_DELAY_MS = 1000;

type Kept = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

/** Stores the session, without pixels, after each change; closing the tab deletes it. Returns a function that stops this. */
export function followKeeping(tab: Kept, write: () => Promise<string>): () => void {
  setKeeping(tab.getItem(ALLOWED) !== null);
  setKept(tab.getItem(SESSION));
  let timer: ReturnType<typeof setTimeout> | undefined;
  return effect(() => {
    const isOn = isKeeping.value;
    const isWorth = hasVolume.value && document_.value !== given.value;
    clearTimeout(timer);
    if (kept.value !== null) {
      return;
    }
    if (!(isOn && isWorth)) {
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

/** Performs `go` at once if everything is saved, otherwise after the user has agreed. */
export async function leave(go: () => Promise<unknown>): Promise<void> {
  if (document_.value === saved.value) {
    await go();
  } else {
    askToLeave({ words: lossWords(document_.value, saved.value), go });
  }
}

/** Lets the browser ask before a reload loses unsaved work. */
export function guardLeaving(page: Pick<Window, 'addEventListener'>): void {
  page.addEventListener('beforeunload', (event) => {
    if (document_.value !== saved.value) {
      event.preventDefault();
    }
  });
}

export function lossWords(document: Document, kept: Document): string {
  const count = document.vessels.filter((vessel) => !kept.vessels.includes(vessel)).length;
  const [vessels, were] = count === 1 ? ['1 vessel', 'was'] : [`${count} vessels`, 'were'];
  return `Discard ${count > 0 ? `${vessels} that ${were}` : 'changes that were'} not saved?`;
}
