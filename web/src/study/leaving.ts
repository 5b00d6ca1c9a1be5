/** What was made of a scan is not lost unasked: closing it, and opening another one in its place, wait for an answer. */
import { signal } from '@preact/signals';
import type { Document } from '../state/document';
import { document_, saved } from '../state/history';

/** What waits for an answer, and what would be lost by it; null where nothing waits. */
export interface Leaving {
  readonly words: string;
  go(): Promise<unknown>;
}

export const leaving = signal<Leaving | null>(null);

/** Does what takes the place of the document, after asking where that was not saved. */
export async function leave(go: () => Promise<unknown>): Promise<void> {
  if (document_.value === saved.value) {
    await go();
  } else {
    leaving.value = { words: lossWords(document_.value, saved.value), go };
  }
}

/** Lets the browser ask before the page goes with what was not saved, as by a reload. */
export function guardLeaving(page: Pick<Window, 'addEventListener'>): void {
  page.addEventListener('beforeunload', (event) => {
    if (document_.value !== saved.value) {
      event.preventDefault();
    }
  });
}

/** What would be lost, as a question. */
export function lossWords(document: Document, kept: Document): string {
  const count = document.vessels.filter((vessel) => !kept.vessels.includes(vessel)).length;
  const [vessels, were] = count === 1 ? ['1 vessel', 'was'] : [`${count} vessels`, 'were'];
  return `Discard ${count > 0 ? `${vessels} that ${were}` : 'changes that were'} not saved?`;
}
