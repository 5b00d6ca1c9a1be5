/** Asks the user before closing or opening a scan would lose unsaved work. */
import type { Document } from '../state/document';
import { document_, saved } from '../state/history';
import { askToLeave } from '../state/questions';

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
