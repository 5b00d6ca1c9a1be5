/** Which contours a section shows, and in which colours. */
import { expect, test } from 'vitest';
import type { MeasuredSection, Vector } from '../src/core/messages';
import { CONTOUR, contours } from '../src/measure/SectionMarks';
import { madeProfile } from './measured';

const LINE: readonly Vector[] = [
  [0, 0, 0],
  [1, 0, 0],
  [0, 1, 0],
];
const section = (changes: Partial<MeasuredSection>): MeasuredSection => ({
  number: 0,
  contour: [],
  outer_contour: [],
  own_lumen: [],
  other_lumen: [],
  shortest: null,
  longest: null,
  ...changes,
});
const profile = { ...madeProfile(2), counts: [true, false] };
const shown = (changes: Partial<MeasuredSection>, pulled?: readonly Vector[]) =>
  contours(section(changes), profile, pulled).map(({ color, dashes }) => [color, dashes.length > 0]);

test('only contours that were found are shown, each in its colour', () => {
  expect(shown({})).toEqual([]);
  expect(shown({ contour: LINE })).toEqual([[CONTOUR.counts, false]]);
  expect(shown({ number: 1, contour: LINE, outer_contour: LINE })).toEqual([
    [CONTOUR.leftOut, false],
    [CONTOUR.outer, true],
  ]);
  expect(shown({ contour: LINE }, LINE)).toEqual([[CONTOUR.byHand, true]]);
  expect(shown({ own_lumen: LINE, other_lumen: LINE })).toEqual([
    [CONTOUR.own, false],
    [CONTOUR.other, false],
  ]);
});
