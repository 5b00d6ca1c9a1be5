/** Questions that the page asks the user, and choices about what is saved and kept. */
import { computed, signal } from '@preact/signals';
import type { GivenFile } from '../core/messages';

/** Closing or opening a scan would lose unsaved work: the question, and what waits for the answer. */
export interface Leaving {
  readonly words: string;
  go(): Promise<unknown>;
}

export const leaving = signal<Leaving | null>(null);

export function askToLeave(question: Leaving | null): void {
  leaving.value = question;
}

/** Files of a volume that may be a new scan or a vessel mask, until the user decides. */
export interface UnclearFiles {
  readonly files: readonly GivenFile[];
  /** Whether their grid is that of a mask of the open scan. */
  readonly canBeMask: boolean;
}

export const unclearFiles = signal<UnclearFiles | null>(null);

export function askWhatIs(unclear: UnclearFiles | null): void {
  unclearFiles.value = unclear;
}

/** A file of the study in which objects for a PACS could be saved. */
export interface ChosenFile {
  readonly file: GivenFile;
  /** Labels and values of patient name, ID, date, modality and body part. */
  readonly facts: ReadonlyArray<readonly [string, string]>;
  readonly doubts: readonly string[];
  /** Why the file is rejected; null if it is accepted. */
  readonly refusal: string | null;
}

export const isPacsAsked = signal(false);

export const chosenFile = signal<ChosenFile | null>(null);

export function setPacsAsked(isAsked: boolean): void {
  isPacsAsked.value = isAsked;
}

export function chooseFile(file: ChosenFile | null): void {
  chosenFile.value = file;
}

export const isScanNamed = signal(false);

export function setScanNamed(isNamed: boolean): void {
  isScanNamed.value = isNamed;
}

export const isKeeping = signal(false);

export function setKeeping(isOn: boolean): void {
  isKeeping.value = isOn;
}

/** The session kept from before the reload, until the user continues with it or discards it. */
export const kept = signal<string | null>(null);

export function setKept(session: string | null): void {
  kept.value = session;
}

export type QuestionName = 'leave' | 'file' | 'study' | 'pacs' | 'kept';

/** The only question that is shown; others wait until it is answered. */
export const shownQuestion = computed<QuestionName | null>(() => {
  if (leaving.value) {
    return 'leave';
  }
  if (unclearFiles.value) {
    return 'file';
  }
  if (chosenFile.value) {
    return 'study';
  }
  if (isPacsAsked.value) {
    return 'pacs';
  }
  return kept.value === null ? null : 'kept';
});

/** Answers the shown question without any effect. Returns false if there is none, or if it must be decided. */
export function escapeQuestion(): boolean {
  switch (shownQuestion.value) {
    case 'leave':
      askToLeave(null);
      return true;
    case 'file':
      askWhatIs(null);
      return true;
    case 'study':
      chooseFile(null);
      return true;
    case 'pacs':
      setPacsAsked(false);
      return true;
    default:
      return false;
  }
}
