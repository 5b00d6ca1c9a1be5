/** Tests of the position of the buttons at the section, and of font sizes in key images. */
import { expect, test } from 'vitest';
import { leftOf } from '../src/measure/chart-layout';
import { fittingSize } from '../src/output/wrapping';

test('the bar is centred on its column and never crosses an edge', () => {
  expect(leftOf(500, 400, 1000)).toBe(300);
  expect(leftOf(990, 400, 1000)).toBe(596);
  expect(leftOf(5, 400, 1000)).toBe(4);
  expect(leftOf(100, 400, 300)).toBe(4);
});

test('texts of a key image never overlap', () => {
  expect(fittingSize(20, 400, 284)).toBe(14);
  expect(fittingSize(20, 4000, 284)).toBe(11);
});
