/** The names of the methods in the page are those of the engine. */
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { STENOSIS_METHODS, VIEW_METHODS } from '../src/core/method-names';

const TABLES = `
import json
from lumencut import _lumencut
print(json.dumps([_lumencut.VIEW_METHODS, _lumencut.STENOSIS_METHODS]))
`;

test('methods have the names that the engine uses', () => {
  const python = join(import.meta.dirname, '../../.venv/bin/python');
  const { stdout, stderr } = spawnSync(python, ['-c', TABLES], { encoding: 'utf-8' });
  expect(stderr).toBe('');
  expect([VIEW_METHODS, STENOSIS_METHODS]).toEqual(JSON.parse(stdout));
});
