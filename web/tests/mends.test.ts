/** The page has a text for every remedy, without names of Python arguments. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import { MEND_NAMES, type MendName, mendWords } from '../src/core/mends';

const VALUES: Partial<Record<MendName, readonly string[]>> = {
  coordinates: ['lps', 'ras'],
  place: ['lps', 'ras'],
  reading: ['lps in cm', 'ras in m'],
  unit: ['cm', 'dm'],
  phase: ['0', '400'],
};
/** Matches the name of a Python argument, such as `fill_gaps=True`, `coordinates=` or `window`. */
const PYTHON = /\w=|`\w+_\w+`|=True/;

test.each(MEND_NAMES)('%s is worded by the page', (name) => {
  for (const values of [VALUES[name] ?? [], []]) {
    const mends = [{ name, values }];
    const words = mendWords({ name, values });
    expect(words.length).toBeGreaterThan(10);
    expect(words.replace('?device=cpu', '')).not.toMatch(PYTHON);
    expect(new Failure('format', 'a', 'b', 'c', 'd', { mends }).message).toBe(
      `a: found b; expected c; d, or ${words}`,
    );
  }
});

test('the choices are named', () => {
  const words = (name: MendName) => mendWords({ name, values: VALUES[name] ?? [] });
  expect(words('coordinates')).toContain('LPS or RAS');
  expect(words('unit')).toContain('cm or dm');
  expect(words('reading')).toContain('LPS in cm or RAS in m');
});

test('no text of the page names a Python argument, and no code searches error texts for words', () => {
  const folder = join(import.meta.dirname, '../src');
  const files = readdirSync(folder, { recursive: true, encoding: 'utf8' });
  const sources = files.filter((name) => /\.tsx?$/.test(name) && !name.startsWith('core/pkg'));
  expect(sources.length).toBeGreaterThan(20);
  for (const name of sources) {
    const text = readFileSync(join(folder, name), 'utf8');
    expect(text, name).not.toMatch(/=True/);
    expect(text, name).not.toMatch(
      /\b(found|expected|subject|advice|mending|message|mend)\s*\.(includes|startsWith|endsWith|match|indexOf|search)\(/,
    );
  }
});
