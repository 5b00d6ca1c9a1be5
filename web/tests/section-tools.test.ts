/** Position of the buttons at the section, and font sizes of key images. */
import { expect, test } from 'vitest';
import { leftOf } from '../src/measure/SectionTools';
import { fittingSize } from '../src/output/wrapping';

// The page's engine needs a worker, which tests lack.
test('the bar stands over its column and never runs off an edge', () => {
  expect(leftOf(500, 400, 1000)).toBe(300);
  expect(leftOf(990, 400, 1000)).toBe(596);
  expect(leftOf(5, 400, 1000)).toBe(4);
  expect(leftOf(100, 400, 300)).toBe(4);
});

test('texts of a key image never overlap', () => {
  expect(fittingSize(20, 400, 284)).toBe(14);
  expect(fittingSize(20, 4000, 284)).toBe(11);
});
