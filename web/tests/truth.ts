/** Results of the Python package for test files, and their comparison with those of the page. */
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect } from 'vitest';
import type { Mend } from '../src/core/mends';
import type { Wanted } from '../src/io/dicom/wanted';
import type { Result } from './opened';

export interface Expected {
  readonly name: string;
  readonly kind: 'volume' | 'series';
  /** The file or folder that Python read, and the folder of all related files. */
  readonly path: string;
  readonly folder: string;
  readonly wanted?: Partial<Wanted>;
  readonly size: readonly number[];
  readonly affine: readonly (readonly number[])[];
  readonly dtype: string;
  readonly sha256: string;
  /** Present for lossy files, whose values decoders round differently. */
  readonly values?: string;
  readonly notes: readonly string[];
  readonly states: { readonly spacing: boolean; readonly orientation: boolean };
  readonly found?: string;
  readonly expected: string;
  readonly mend: string;
  readonly mends: readonly Mend[];
  readonly series: readonly string[];
}

const here = fileURLToPath(new URL('.', import.meta.url));

/** Results of the Python package; empty if it is not installed. */
export function everyTruth(): readonly Expected[] {
  const folder = process.env.LUMENCUT_SAMPLES ?? written();
  const path = folder === null ? '' : join(folder, 'expected.json');
  return existsSync(path) ? JSON.parse(readFileSync(path, 'utf-8')) : [];
}

function written(): string | null {
  const python = join(here, '../../.venv/bin/python');
  if (!existsSync(python)) {
    return null;
  }
  const folder = mkdtempSync(join(tmpdir(), 'lumencut-samples-'));
  const done = spawnSync(python, [join(here, 'samples.py'), folder], {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  if (done.status !== 0) {
    throw new Error(`samples.py ended with ${done.status}`);
  }
  return folder;
}

function inThePage(dtype: string): string {
  return ['int8', 'uint8', 'int16', 'uint16'].includes(dtype) ? dtype : 'float32';
}

export function sameVolume({ memory, failure, notes, states }: Result, truth: Expected): void {
  expect(failure?.message ?? '').toBe('');
  expect(memory.header?.size).toEqual(truth.size);
  expect(states).toEqual(truth.states);
  expect(memory.header?.dtype).toBe(inThePage(truth.dtype));
  const largest = Math.max(...truth.affine.flat().map(Math.abs));
  memory.header?.world_from_index.flat().forEach((value, i) => {
    expect(Math.abs(value - (truth.affine.flat()[i] ?? 0))).toBeLessThanOrEqual(1e-12 * largest);
  });
  sameValues(memory.values, truth);
  // Notes that `lumencut info` or the engine adds do not come from a reader, so they are not compared.
  const isNote = (note: string) => !/^(values are scaled|a straightened vessel:|the scan is )/.test(note);
  expect(notes).toEqual(truth.notes.filter(isNote));
}

function sameValues(values: Float32Array, truth: Expected): void {
  if (truth.values !== undefined) {
    const bytes = readFileSync(truth.values);
    const own = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
    expect(own.length).toBe(values.length);
    expect(
      own.reduce((apart, value, i) => Math.max(apart, Math.abs(value - (values[i] ?? 0))), 0),
    ).toBeLessThanOrEqual(1);
    return;
  }
  const sum = createHash('sha256').update(
    new Uint8Array(values.buffer, values.byteOffset, values.byteLength),
  );
  expect(sum.digest('hex')).toBe(truth.sha256);
}

export function refusedLike({ failure }: Result, truth: Expected): void {
  expect(failure).not.toBeNull();
  const { found, expected, advice, mends } = failure ?? {};
  expect({ found, expected, advice, mends }).toEqual({
    found: truth.found,
    expected: truth.expected,
    advice: truth.mend,
    mends: truth.mends,
  });
  expect(failure?.series.map((one) => one.uid)).toEqual(truth.series);
}
