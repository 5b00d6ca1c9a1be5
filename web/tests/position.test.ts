import { expect, test } from 'vitest';
import { positionText } from '../src/ui/StatusBar';

test('a position is written as radiologists write it', () => {
  expect(positionText([-17.6, 35.34, 12.06])).toBe('R 17.6 P 35.3 S 12.1');
  expect(positionText([1, -2, -3])).toBe('L 1.0 A 2.0 I 3.0');
  expect(positionText([0, 0, 0])).toBe('L 0.0 P 0.0 S 0.0');
});
