/** Tests of the anatomical names that are offered for vessels. */
import { expect, test } from 'vitest';
import { namesToOffer } from '../src/edit/vessels';

test('paired arteries are offered once per side, and no name twice', () => {
  const names = namesToOffer([]);
  expect(names).toContain('Left renal artery');
  expect(names).toContain('Right renal artery');
  expect(names).not.toContain('renal artery');
  expect(new Set(names).size).toBe(names.length);
  expect(names).toEqual([...names].sort((a, b) => a.localeCompare(b, 'en')));
});

test('a name that a vessel already has is not offered, whatever its capitals', () => {
  const names = namesToOffer(['aorta ', 'RIGHT RENAL ARTERY', '']);
  expect(names).not.toContain('Aorta');
  expect(names).not.toContain('Right renal artery');
  expect(names).toContain('Left renal artery');
  expect(names).toContain('Abdominal aorta');
});
