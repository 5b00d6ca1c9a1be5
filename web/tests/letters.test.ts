import { expect, test } from 'vitest';
import { barLength, lettersOf, positionText } from '../src/views/letters';

test('each direction of the patient has its letter', () => {
  expect(lettersOf([1, 0, 0])).toBe('L');
  expect(lettersOf([-1, 0, 0])).toBe('R');
  expect(lettersOf([0, 1, 0])).toBe('P');
  expect(lettersOf([0, -1, 0])).toBe('A');
  expect(lettersOf([0, 0, 1])).toBe('S');
  expect(lettersOf([0, 0, -1])).toBe('I');
});

test('an oblique direction has two letters at most, the strongest first', () => {
  expect(lettersOf([0.6, -0.8, 0])).toBe('AL');
  expect(lettersOf([-0.5, 0.6, -0.62])).toBe('IP');
  expect(lettersOf([0.99, 0.1, 0.1])).toBe('L');
});

test('a bar is the longest of 1, 2 and 5 times a power of ten that fits', () => {
  expect([1, 1.99, 2, 4.9, 5, 9.9, 10, 75, 199, 200].map(barLength)).toEqual([
    1, 1, 2, 2, 5, 5, 10, 50, 100, 200,
  ]);
  expect(barLength(0.3)).toBeCloseTo(0.2, 12);
});

test('a position reads as radiologists write it', () => {
  expect(positionText([-17.6, 35.34, 12.06])).toBe('R 17.6 P 35.3 S 12.1');
  expect(positionText([1, -2, -3])).toBe('L 1.0 A 2.0 I 3.0');
  expect(positionText([0, 0, 0])).toBe('L 0.0 P 0.0 S 0.0');
});
