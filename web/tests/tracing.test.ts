import { expect, test } from 'vitest';
import type { Vector } from '../src/core/messages';
import { nextColor, PALETTE } from '../src/state/changes';
import { distance, EMPTY, edited, lineOf, opened, refusal } from './traced';

test('a line between two clicks follows the vessel there', async () => {
  const { engine, report } = await opened('y_junction');
  const [trunk] = report().vessels ?? [];
  const truth = await engine.ask('line', { line: trunk?.line ?? -1 });
  const ends = [truth.points[4], truth.points.at(-5)] as Vector[];
  const begin = { kind: 'begin_vessel', clicks: ends } as const;
  const begun = await edited(engine, begin);
  const { points, radius, confidence, bridged } = await engine.ask('line', { line: lineOf(begun) });
  const away = points.map((point) => Math.min(...truth.points.map((known) => distance(known, point))));
  expect(Math.max(...away)).toBeLessThan(0.5);
  expect([radius?.length, confidence?.length, bridged?.length]).toEqual(
    points.map(() => points.length).slice(0, 3),
  );
  expect(lineOf(await edited(engine, begin))).toBe(lineOf(begun));
  const way = await engine.ask('path', {
    from: ends[0] as Vector,
    to: ends[1] as Vector,
    stoppers: [],
    bridge: false,
  });
  expect(way?.[0]).toEqual(ends[0]);
  expect(way?.at(-1)).toEqual(ends[1]);
});

test('a click outside lumen is rejected, with its position and the value there', async () => {
  const { engine, report } = await opened('y_junction');
  const [corner] = report().volume?.corners ?? [];
  const truth = await engine.ask('line', { line: report().vessels?.[0]?.line ?? -1 });
  const inside = truth.points[4] as Vector;
  const air = (corner ?? inside).map((c, a) => 0.9 * c + 0.1 * (inside[a] ?? 0)) as unknown as Vector;
  const failure = await refusal(edited(engine, { kind: 'begin_vessel', clicks: [inside, air] }));
  expect([failure.kind, failure.subject]).toEqual(['tracing', 'this point']);
  expect(distance(failure.place ?? [0, 0, 0], air)).toBeLessThan(1e-9);
  expect(failure.value).not.toBeNull();
  expect(await engine.ask('path', { from: inside, to: air, stoppers: [], bridge: false })).toBeNull();
});

test('a stop cancels tracing that has not begun, but no later request', async () => {
  const { engine, report, cancel } = await opened('y_junction');
  const { points } = await engine.ask('line', { line: report().vessels?.[0]?.line ?? -1 });
  const ends = [points[4], points.at(-5)] as Vector[];
  const begin = { kind: 'begin_vessel', clicks: ends } as const;
  const stopped = refusal(edited(engine, begin));
  cancel();
  expect((await stopped).kind).toBe('interrupted');
  expect((await edited(engine, begin)).added).toHaveLength(1);
});

test('displayed vessels can be cut, joined and displayed again', async () => {
  const { engine } = await opened('stenosis');
  const whole = await engine.ask('begin_document', null);
  expect(whole.vessels).toMatchObject([
    { id: 1, color: '#56b4e9', isHidden: false, clicks: null, doubt: null },
  ]);
  const cut = await edited(engine, { kind: 'cut', id: 1, at: 20 }, whole);
  expect([cut.words, cut.added, cut.without_marks]).toEqual(['cut a vessel', [2], [1]]);
  const named = cut.document.vessels.map(({ line }, n) => ({
    ...{ line, name: `part ${n}`, hidden: false, contours: [] },
  }));
  const shown = await engine.ask('show', { lines: named, bone_hidden: false, dark: false });
  expect(shown.vessels?.map(({ name, length }) => [name, Math.round(length)])).toEqual([
    ['part 0', 20],
    ['part 1', 40],
  ]);
  const joined = await edited(engine, { kind: 'join', id: 2, other: 1 }, cut.document);
  const { points } = await engine.ask('line', { line: lineOf(joined) });
  expect(points).toEqual((await engine.ask('line', { line: whole.vessels[0]?.line ?? -1 })).points);
  expect((await engine.ask('show', { lines: [], bone_hidden: false, dark: false })).vessels).toBeNull();
  const far = await refusal(edited(engine, { kind: 'cut', id: 1, at: 99 }, whole));
  expect(far.kind).toBe('vessel tree');
});

test('a vessel being drawn has the colour that the engine will give it', async () => {
  const { engine } = await opened('stenosis');
  const { vessels } = await engine.ask('begin_document', null);
  const lines = Array.from({ length: 2 * PALETTE.length }, () => ({
    line: vessels[0]?.line ?? -1,
    name: '',
  }));
  const { document } = await edited(engine, { kind: 'add_lines', lines });
  for (const [n, vessel] of document.vessels.entries()) {
    expect(vessel.color).toBe(nextColor(document.vessels.slice(0, n)));
  }
});

test('the engine returns a document with bit-identical numbers', async () => {
  const { engine } = await opened('stenosis');
  const odd: Vector = [0.1 + 0.2, 1 / 3, -1e-17];
  const { vessels, ...rest } = await engine.ask('begin_document', null);
  const document = { ...rest, vessels: vessels.map((vessel) => ({ ...vessel, clicks: [odd, odd] })) };
  const same = await edited(engine, { kind: 'accept', ids: [1] }, document);
  expect(JSON.stringify(same.document.vessels)).toBe(JSON.stringify(document.vessels));
});

test('files that are not masks are rejected, and the scan stays open', async () => {
  const { engine, report } = await opened('stenosis');
  const before = report();
  const table = new File(['x,y,z\n0,0,0\n1,0,0\n'], 'line.csv');
  const request = { document: EMPTY, edit: { kind: 'add_mask' }, bridging: false } as const;
  const failure = await refusal(engine.ask('edit', request, { mask: [{ path: 'line.csv', file: table }] }));
  expect([failure.found, failure.expected]).toEqual(['centerlines', 'a vessel mask']);
  expect(report()).toEqual(before);
});
