/** Asks before unsaved work is lost by closing or opening. */
import { signal } from '@preact/signals';
import type { Document } from '../state/document';
import { document_, saved } from '../state/history';

/** The pending action, and the question about the loss; null if none. */
export interface Leaving {
  readonly words: string;
  go(): Promise<unknown>;
}

export const leaving = signal<Leaving | null>(null);

/** Acts at once if everything is saved, otherwise asks. */
export async function leave(go: () => Promise<unknown>): Promise<void> {
  if (document_.value === saved.value) {
    await go();
  } else {
    leaving.value = { words: lossWords(document_.value, saved.value), go };
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
