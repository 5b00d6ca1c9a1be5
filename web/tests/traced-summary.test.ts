import { expect, test } from 'vitest';
import type { DocumentVessel, Told } from '../src/core/messages';
import { EMPTY } from '../src/state/document';
import { storeSummary, tracedSummary } from '../src/state/drawing';
import { begin, change, undo } from '../src/state/history';

const VESSEL: DocumentVessel = {
  id: 3,
  line: 7,
  name: 'Vessel 1',
  color: '#56b4e9',
  isHidden: false,
  clicks: null,
  doubt: null,
  contours: [],
};
const TOLD: Told = { vessel: 3, words: 'Vessel 1, 80.0 mm.', doubts: [{ words: 'Doubtful.', at: 40 }] };
const document = (vessel: DocumentVessel) => ({ ...EMPTY, vessels: [vessel] });
const edited = (vessel: DocumentVessel, told: Told | null) => ({
  document: document(vessel),
  words: 'x',
  added: [],
  without_marks: [],
  notes: [],
  doubts: [],
  told,
});

test('the summary of a vessel is shown until the vessel changes', () => {
  begin(EMPTY);
  change('trace', document(VESSEL));
  storeSummary(edited(VESSEL, TOLD));
  expect(tracedSummary.value).toEqual(TOLD);
  change('name', document({ ...VESSEL, name: 'aorta' }));
  expect(tracedSummary.value).toEqual(TOLD);
  change('cut', document({ ...VESSEL, line: 8 }));
  expect(tracedSummary.value).toBeNull();
  undo();
  expect(tracedSummary.value).toEqual(TOLD);
  undo();
  undo();
  expect(tracedSummary.value).toBeNull();
});

test('an edit that does not trace a single vessel has no summary', () => {
  begin(document(VESSEL));
  storeSummary(edited(VESSEL, TOLD));
  storeSummary(edited(VESSEL, null));
  expect(tracedSummary.value).toBeNull();
});
