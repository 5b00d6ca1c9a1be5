/** Undo and redo of changes to the document and the grey-value window. */
import { batch, computed, signal } from '@preact/signals';
import type { Window } from '../core/messages';
import { type Document, EMPTY } from './document';
import { window_ } from './store';

interface Step {
  /** Description of the step, such as `add a point`. */
  readonly words: string;
  readonly before: Document;
  readonly after: Document;
  /** Present if the step changed the grey-value window, which is not part of the document. */
  readonly window?: { readonly before: Window; readonly after: Window };
}

const past = signal<readonly Step[]>([]);
const future = signal<readonly Step[]>([]);

export const document_ = signal<Document>(EMPTY);

/** The document as it was last saved or opened. Later changes would be lost on closing. */
export const saved = signal<Document>(EMPTY);

/** The document as the files of the scan gave it; to keep it would keep nothing of the user. */
export const given = signal<Document>(EMPTY);

export function setGiven(document: Document): void {
  given.value = document;
}

export function markSaved(document: Document): void {
  saved.value = document;
}

/** Descriptions of the next steps to undo and to redo; null if there is none. */
export const undoWords = computed(() => past.value.at(-1)?.words ?? null);
export const redoWords = computed(() => future.value.at(-1)?.words ?? null);

/** Whether any undo or redo step changed the document. */
export const hasEdits = computed(() =>
  [...past.value, ...future.value].some(({ before, after }) => before !== after),
);

/** Replaces the document as one undo step. */
export function change(words: string, after: Document): void {
  const before = document_.value;
  if (after === before) {
    return;
  }
  take({ words, before, after });
}

export function windowChanged(before: Window): void {
  const [document, after] = [document_.value, window_.value];
  if (after[0] !== before[0] || after[1] !== before[1]) {
    take({ words: 'change the window', before: document, after: document, window: { before, after } });
  }
}

function take(step: Step): void {
  batch(() => {
    past.value = [...past.value, step];
    future.value = [];
    document_.value = step.after;
  });
}

export function preview(during: Document): void {
  document_.value = during;
}

/** Ends a drag: all changes since the document `begun` become one undo step. */
export function endPreview(words: string, begun: Document): void {
  const after = document_.value;
  document_.value = begun;
  change(words, after);
}

export function undo(): void {
  const step = past.value.at(-1);
  if (step) {
    batch(() => {
      past.value = past.value.slice(0, -1);
      future.value = [...future.value, step];
      document_.value = step.before;
      window_.value = step.window?.before ?? window_.value;
    });
  }
}

export function redo(): void {
  const step = future.value.at(-1);
  if (step) {
    batch(() => {
      future.value = future.value.slice(0, -1);
      past.value = [...past.value, step];
      document_.value = step.after;
      window_.value = step.window?.after ?? window_.value;
    });
  }
}

export function begin(document: Document): void {
  batch(() => {
    past.value = [];
    future.value = [];
    document_.value = document;
    saved.value = document;
  });
}
