/** The document and the window with what they were before: undo and redo of everything. */
import { batch, computed, signal } from '@preact/signals';
import type { Window } from '../core/messages';
import { type Document, EMPTY } from './document';
import { window_ } from './store';

interface Step {
  /** What was done, such as `add a point`. */
  readonly words: string;
  readonly before: Document;
  readonly after: Document;
  /** The windows of a step that changed the window, which is no part of the document. */
  readonly window?: { readonly before: Window; readonly after: Window };
}

const past = signal<readonly Step[]>([]);
const future = signal<readonly Step[]>([]);

/** What the user made of the scan. */
export const document_ = signal<Document>(EMPTY);

/** The document as it was last saved, or as the study began: another one is lost when the study is closed. */
export const saved = signal<Document>(EMPTY);

/** A document is saved as a session or as centerlines. */
export function markSaved(document: Document): void {
  saved.value = document;
}

/** What undo and redo would do; null where there is nothing. */
export const undoWords = computed(() => past.value.at(-1)?.words ?? null);
export const redoWords = computed(() => future.value.at(-1)?.words ?? null);

/** Whether a step that can be undone or done again changed the document. */
export const hasEdits = computed(() =>
  [...past.value, ...future.value].some(({ before, after }) => before !== after),
);

/** Makes another document of the one there is, as one step that can be undone. */
export function change(words: string, after: Document): void {
  const before = document_.value;
  if (after === before) {
    return;
  }
  take({ words, before, after });
}

/** The window has become what it is from what it was before, as one step that can be undone. */
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

/** Changes the document while a drag is under way: no step of its own until `change` ends it from `begun`. */
export function preview(during: Document): void {
  document_.value = during;
}

/** Ends a drag: all that was previewed since the document was `begun` becomes one step. */
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

/** Another study: nothing of the former is left. */
export function begin(document: Document): void {
  batch(() => {
    past.value = [];
    future.value = [];
    document_.value = document;
    saved.value = document;
  });
}
