import { beforeEach, expect, test } from 'vitest';
import {
  askToLeave,
  askWhatIs,
  chooseFile,
  escapeQuestion,
  kept,
  setKept,
  setPacsAsked,
  shownQuestion,
} from '../src/state/questions';

beforeEach(() => {
  askToLeave(null);
  askWhatIs(null);
  chooseFile(null);
  setPacsAsked(false);
  setKept(null);
});

test('one question is shown at a time, and Escape answers one after another', () => {
  setKept('session');
  setPacsAsked(true);
  chooseFile({ file: { path: 'a', file: new File([], 'a') }, facts: [], doubts: [], refusal: null });
  askWhatIs({ files: [], canBeMask: false });
  let gone = 0;
  askToLeave({ words: 'Discard?', go: async () => (gone += 1) });
  const seen = [];
  do {
    seen.push(shownQuestion.value);
  } while (escapeQuestion());
  expect(seen).toEqual(['leave', 'file', 'study', 'pacs', 'kept']);
  expect(gone).toBe(0);
  // Neither answer about kept vessels is without effect, so Escape gives none.
  expect(kept.value).toBe('session');
});
