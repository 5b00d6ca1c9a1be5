/** The page measures the same as the Python package, whose results `measured.py` writes. */
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { SECTION_PIXELS } from '../src/core/generated/tables';
import type { Asked, MeasuredVessel, Pair, Profile } from '../src/core/messages';
import { NO_MARKS } from '../src/state/document';
import { opened } from './traced';

/** Allowed difference, relative or in mm, since compilers round sums and sines differently. */
const ROUNDING = 1e-9;

interface Truth {
  readonly profiles: readonly Profile[];
  readonly drawn: readonly unknown[];
  readonly asked: { readonly at: number; readonly references: Pair; readonly [name: string]: unknown };
  readonly csv: string;
  readonly json: string;
  readonly report: string;
}

const here = import.meta.dirname;
const python = join(here, '../../.venv/bin/python');

/** What Python measures with this FWHM (mm; 0 to estimate it); its plots have axes of these heights. */
function truth(phantom: string, fwhm: number, heights: readonly number[]): Truth {
  const done = spawnSync(python, [join(here, 'measured.py'), phantom, ...[fwhm, ...heights].map(String)], {
    encoding: 'utf-8',
    maxBuffer: 1 << 26,
  });
  if (done.status !== 0) {
    throw new Error(`measured.py ended with ${done.status}: ${done.stderr}`);
  }
  return JSON.parse(done.stdout);
}

/** The first place where two JSON values differ by more than `ROUNDING`; empty if they agree. */
function apart(found: unknown, expected: unknown, path = ''): string {
  if (typeof found === 'number' && typeof expected === 'number') {
    const most = ROUNDING * Math.max(1, Math.abs(expected));
    return Math.abs(found - expected) <= most ? '' : `${path}: ${found}, not ${expected}`;
  }
  if (found && expected && typeof found === 'object' && typeof expected === 'object') {
    const names = Object.keys(expected);
    if (Object.keys(found).join() !== names.join()) {
      return `${path}: ${Object.keys(found)}, not ${names}`;
    }
    const at = (value: object, name: string) => (value as Record<string, unknown>)[name];
    const differences = names.map((name) => apart(at(found, name), at(expected, name), `${path}/${name}`));
    return differences.find((difference) => difference !== '') ?? '';
  }
  return found === expected ? '' : `${path}: ${found}, not ${expected}`;
}

function fields(table: string): (number | string)[] {
  const words = table.split(/[,\n]/);
  return words.map((word) => (word === '' || Number.isNaN(Number(word)) ? word : Number(word)));
}

const withoutNumbers = (json: string) => json.replace(/-?\d+\.\d+(e[+-]?\d+)?/g, '0');

async function answers(engine: Asked, line: number, length: number, { at, references }: Truth['asked']) {
  const { stenosis: graded } = await engine.ask('grade', {
    line,
    marks: { ...NO_MARKS, at, references, method: 'area' },
  });
  const section = await engine.ask('measured_section', { line, at });
  const stretch = await engine.ask('stretch', { line, ends: references });
  const spots = await engine.ask('offered_references', { line, marks: { ...NO_MARKS, at } });
  const { diameter, uncertainty } = await engine.ask('diameter_at', { line, at });
  return {
    at: graded?.at,
    references: graded?.references.map((spot) => spot.at),
    percent: graded?.percent,
    // The Python package writes percentage and doubts as one line.
    words: [graded?.words, graded?.doubts.join(' ')].filter(Boolean).join('. '),
    doubts: await engine.ask('doubts', { line, compared: { at, references, method: 'area' } }),
    suggested: spots.map((spot) => spot && { arc_length: spot.at, diameter: spot.diameter }),
    diameter_at: [diameter, uncertainty],
    number: section.number,
    contour: section.contour,
    length: stretch.length,
    straight: stretch.straight,
    tortuosity: stretch.tortuosity,
    direction: stretch.direction,
    c_arm: stretch.c_arm,
    angle: await engine.ask('angle_between', {
      line,
      first: [0, references[0]],
      second: [references[1], length],
    }),
  };
}

async function reported(engine: Asked, vessel: MeasuredVessel, length: number): Promise<string> {
  const { places } = await engine.ask('report_plan', vessel);
  return engine.ask('measured_report', {
    vessels: [
      {
        vessel,
        view: { picture: 'QUJD', method: 'csr' },
        strip: { picture: 'QUJD', size: [1344, 100], spacing: length / 1344 },
        sections: places.map(() => 'QUJD'),
      },
    ],
    scan: null,
    saved: 'a day',
    stated: { has_units: true, has_orientation: true },
    is_millimetre_assumed: false,
    window: [300, 700],
    settings: {},
    distances: [],
  });
}

/** The text of a report, without the picture of the view and the date. */
function textOf(report: string): string[] {
  const body = report.slice(report.indexOf('<body>'));
  const words = body.split(/<[^>]*>/).map((text) => text.replace('; view CSR', '').trim());
  return words.filter((text) => text !== '' && text !== 'Saved on a day' && !text.startsWith('CSR of'));
}

/** The layout of a vessel in a pane, and the height of its axes (pixels). */
async function drawn(engine: Asked, vessel: MeasuredVessel) {
  const { line } = vessel;
  const pane = { line, is_measured: true, size: [1060, 500], between: 28, density: 1 } as const;
  const { chart, x } = await engine.ask('measure_layout', pane);
  const { section_spacing: spacing, ...plan } = await engine.ask('report_plan', vessel);
  if (!chart) {
    throw new Error('a measured vessel has no chart');
  }
  const { y, bottom, ticks, flags } = chart;
  const layout = {
    side: spacing * (SECTION_PIXELS - 1),
    strip: [plan.width, plan.spacing],
    range: [x.low, x.high, y.high],
    rows: (bottom - y.start) / (bottom - y.end),
    ticks: ticks.map((axis) => axis.map(({ words }) => Number(words))),
    flags: flags.map(({ look }) => look.word),
  };
  return { layout, height: bottom - y.end };
}

test('numbers that differ are told', () => {
  const same = { a: [1, null], b: 'x' };
  expect(apart(same, { a: [1 + 1e-12, null], b: 'x' })).toBe('');
  expect(apart(same, { a: [1 + 1e-6, null], b: 'x' })).toBe('/a/0: 1, not 1.000001');
  expect(apart(same, { a: [1, 2], b: 'x' })).toBe('/a/1: null, not 2');
  expect(apart(same, { a: [1, null] })).toBe(': a,b, not a');
  expect(apart(fields('1,x\n2,'), fields('1,x\n3,'))).toBe('/2: 2, not 3');
});

describe.skipIf(!existsSync(python))('measuring is that of Python', () => {
  // Vessels that meet take seconds, so they are measured by the long tests.
  const phantoms = [
    ['stenosis', 0],
    ['y_junction', 0.7],
  ] as const;
  test.each(phantoms.slice(0, process.env.LUMENCUT_LONG ? 2 : 1))(
    'on the phantom %s',
    async (phantom, fwhm) => {
      const { engine, report } = await opened(phantom);
      // A third vessel would take seconds and add nothing: the branches are symmetric.
      const vessels = (report().vessels ?? []).slice(0, 2);
      const profiles = await Promise.all(
        vessels.map(({ line }) => engine.ask('profile', { line, fwhm: fwhm || null })),
      );
      const measured: MeasuredVessel[] = vessels.map(({ line, name }, n) => {
        return { id: `${n}`, name, line, marks: NO_MARKS };
      });
      const charts = await Promise.all(measured.map((vessel) => drawn(engine, vessel)));
      const heights = charts.map(({ height }) => height);
      const expected = truth(phantom, fwhm, heights);
      expect(profiles.length).toBe(expected.profiles.length);
      expect(apart(profiles, expected.profiles)).toBe('');
      const layouts = charts.map(({ layout }) => layout);
      expect(apart(layouts, expected.drawn)).toBe('');
      const [{ line, length }] = vessels as [(typeof vessels)[0]];
      expect(apart(await answers(engine, line, length, expected.asked), expected.asked)).toBe('');
      const asked = { vessels: measured, is_millimetre_assumed: false };
      expect(apart(fields(await engine.ask('profiles_csv', asked)), fields(expected.csv))).toBe('');
      const json = await engine.ask('profiles_json', asked);
      expect(apart(JSON.parse(json), JSON.parse(expected.json))).toBe('');
      expect(withoutNumbers(json)).toBe(withoutNumbers(expected.json));
      const { at, references } = expected.asked;
      const marks = { ...NO_MARKS, at, references: references.slice(0, 1), group: 'carotid' } as const;
      const [first] = measured as [MeasuredVessel];
      expect(textOf(await reported(engine, { ...first, marks }, length))).toEqual(textOf(expected.report));
    },
  );
});
