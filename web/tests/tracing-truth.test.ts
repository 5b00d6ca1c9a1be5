/** The page traces the same vessels and writes the same files as the Python package. */
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, test } from 'vitest';
import type { CenterlineKind, LineContent, Vector } from '../src/core/messages';
import { EMPTY, edited, lineOf, opened } from './traced';

interface Truth {
  readonly phantom: string;
  readonly mask: string;
  readonly clicks: readonly (readonly Vector[])[];
  readonly lines: readonly LineContent[];
  readonly files: Readonly<Record<CenterlineKind, string>>;
  readonly branches: readonly LineContent[];
  readonly found: readonly LineContent[];
  readonly told: readonly string[];
  readonly masked: readonly LineContent[];
  readonly notes: readonly string[];
}

const root = fileURLToPath(new URL('../..', import.meta.url));

/** Results of the Python package; empty if it is not installed. */
function everyTruth(): readonly Truth[] {
  const python = join(root, '.venv/bin/python');
  if (!existsSync(python)) {
    return [];
  }
  const folder = mkdtempSync(join(tmpdir(), 'lumencut-traced-'));
  const done = spawnSync(python, [join(root, 'web/tests/traced.py'), folder], {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  expect(done.status).toBe(0);
  return JSON.parse(readFileSync(join(folder, 'truth.json'), 'utf-8'));
}

/** Largest difference between corresponding points of two lines (mm). */
function apart(found: LineContent, truth: LineContent): number {
  const flat = ({ points, radius, confidence }: LineContent) => [
    ...points.flat(),
    ...(radius ?? []).map(Number),
    ...(confidence ?? []),
  ];
  expect(found.points.length).toBe(truth.points.length);
  const [own, others] = [flat(found), flat(truth)];
  expect(own.length).toBe(others.length);
  return Math.max(...own.map((number, n) => Math.abs(number - (others[n] ?? Number.NaN))));
}

/** Allowed difference if only the last bits of sines differ between machines (mm). */
const LAST_BITS = 1e-9;
/** Allowed difference if the order of voxels depends on the last bits of their distance from the wall (mm). */
const SHOWN = 1e-3;

const ADD_MASK = { document: EMPTY, edit: { kind: 'add_mask' }, bridging: false } as const;

const every = everyTruth();

describe.skipIf(every.length === 0)('as Python', () => {
  test.each(every)('traces $phantom', async ({ phantom, clicks, lines, files }) => {
    const { engine } = await opened(phantom);
    // All vessels but the last are given; the last one is begun, and all are traced in one edit.
    const vessel = { line: 0, name: '', color: '', isHidden: false, doubt: null, contours: [] };
    const vessels = clicks.slice(0, -1).map((own, n) => ({ ...vessel, id: n + 1, clicks: own }));
    const begin = { kind: 'begin_vessel', clicks: clicks.at(-1) ?? [] } as const;
    const traced = await edited(engine, begin, { ...EMPTY, vessels });
    expect(traced.document.vessels.length).toBe(lines.length);
    for (const [n, truth] of lines.entries()) {
      const found = await engine.ask('line', { line: lineOf(traced, n) });
      expect(apart(found, truth)).toBeLessThan(LAST_BITS);
      expect(found.bridged).toEqual(truth.bridged);
    }
    const own = await Promise.all(lines.map((line) => engine.ask('add_line', line)));
    const named = own.map((line, n) => ({ line, name: `vessel ${n}` }));
    for (const kind of ['vtp', 'mrk.json'] as const) {
      expect(new TextDecoder().decode((await engine.ask('write_lines', { lines: named, kind })).bytes)).toBe(
        files[kind],
      );
    }
  });

  test.each(every)('finds the branches of $phantom', async ({ phantom, clicks, branches }) => {
    const { engine } = await opened(phantom);
    const found = await edited(engine, { kind: 'add_branches', seed: clicks[0]?.[0] ?? [0, 0, 0] });
    expect(found.added.length).toBe(branches.length);
    for (const [n, truth] of branches.entries()) {
      expect(apart(await engine.ask('line', { line: lineOf(found, n) }), truth)).toBeLessThan(SHOWN);
    }
  });

  test.each(every)('finds all vessels of $phantom', async ({ phantom, found: truths, told }) => {
    const { engine } = await opened(phantom);
    const found = await edited(engine, { kind: 'find_vessels', doubtful: false });
    expect(found.notes).toEqual(told);
    expect(found.document.vessels.map(({ name }) => name)).toEqual(truths.map((_, n) => `Vessel ${n + 1}`));
    for (const [n, truth] of truths.entries()) {
      expect(apart(await engine.ask('line', { line: lineOf(found, n) }), truth)).toBeLessThan(SHOWN);
    }
  });

  test.each(every)('traces a mask of $phantom', async ({ phantom, mask, masked, notes }) => {
    const { engine } = await opened(phantom);
    const file = new File([readFileSync(mask)], 'mask.nii.gz');
    const { edited: found } = await engine.ask('edit', ADD_MASK, { mask: [{ path: 'mask.nii.gz', file }] });
    expect(found.notes).toEqual(notes);
    expect(found.document.vessels.map(({ name }) => name)).toEqual(masked.map((_, n) => `Mask ${n + 1}`));
    for (const [n, truth] of masked.entries()) {
      expect(apart(await engine.ask('line', { line: lineOf(found, n) }), truth)).toBeLessThan(SHOWN);
    }
  });
});
