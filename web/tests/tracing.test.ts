import { expect, test } from 'vitest';
import type { Vector } from '../src/core/messages';
import { distance, opened, refusal, unheard } from './traced';

test('a vessel between two clicks follows the one that is there', async () => {
  const { tracing, report } = await opened('y_junction');
  const [trunk] = report().vessels ?? [];
  const truth = await tracing.line(trunk?.line ?? -1);
  const ends = [truth.points[4], truth.points.at(-5)] as Vector[];
  const request = { vessels: [ends], stoppers: [], bridge: false, beside: [] };
  const [line] = await tracing.trace(request, unheard);
  const { points, radius, confidence, bridged } = await tracing.line(line ?? -1);
  const away = points.map((point) => Math.min(...truth.points.map((known) => distance(known, point))));
  expect(Math.max(...away)).toBeLessThan(0.5);
  expect([radius?.length, confidence?.length, bridged?.length]).toEqual(
    points.map(() => points.length).slice(0, 3),
  );
  // The same clicks once more give the same line.
  expect(await tracing.trace(request, unheard)).toEqual([line]);
  const way = await tracing.path({
    from: ends[0] as Vector,
    to: ends[1] as Vector,
    stoppers: [],
    bridge: false,
  });
  expect(way?.[0]).toEqual(ends[0]);
  expect(way?.at(-1)).toEqual(ends[1]);
});

test('a click into no lumen is refused with its place and the value there', async () => {
  const { tracing, report } = await opened('y_junction');
  const [corner] = report().volume?.corners ?? [];
  const truth = await tracing.line(report().vessels?.[0]?.line ?? -1);
  const inside = truth.points[4] as Vector;
  const air = (corner ?? inside).map((c, a) => 0.9 * c + 0.1 * (inside[a] ?? 0)) as unknown as Vector;
  const request = { vessels: [[inside, air]], stoppers: [], bridge: false, beside: [] };
  const failure = await refusal(tracing.trace(request, unheard));
  expect(failure.kind).toBe('tracing');
  expect(distance(failure.place ?? [0, 0, 0], air)).toBeLessThan(1e-9);
  expect(failure.value).not.toBeNull();
  expect(await tracing.path({ from: inside, to: air, stoppers: [], bridge: false })).toBeNull();
});

test('a stop is heard by tracing that has not begun, and not by what is asked for later', async () => {
  const { tracing, report, cancel } = await opened('y_junction');
  const { points } = await tracing.line(report().vessels?.[0]?.line ?? -1);
  const ends = [points[4], points.at(-5)] as Vector[];
  const request = { vessels: [ends], stoppers: [], bridge: false, beside: [] };
  const stopped = refusal(tracing.trace(request, unheard));
  cancel();
  expect((await stopped).kind).toBe('interrupted');
  expect(await tracing.trace(request, unheard)).toHaveLength(1);
});

test('what is shown can be cut, joined and shown again', async () => {
  const { tracing, report } = await opened('stenosis');
  const line = report().vessels?.[0]?.line ?? -1;
  const [first, second] = await tracing.cut(line, 20);
  const named = [first, second].map((part, n) => ({ line: part, name: `part ${n}` }));
  const shown = await tracing.show(named);
  expect(shown.vessels?.map(({ name, length }) => [name, Math.round(length)])).toEqual([
    ['part 0', 20],
    ['part 1', 40],
  ]);
  const joined = await tracing.join(second, first);
  const { points } = await tracing.line(joined);
  expect(points).toEqual((await tracing.line(line)).points);
  expect((await tracing.show([])).vessels).toBeNull();
  expect((await refusal(tracing.cut(line, 99))).kind).toBe('vessel tree');
});

test('files that are no mask are refused, and the scan stays', async () => {
  const { tracing, report } = await opened('stenosis');
  const before = report();
  const table = new File(['x,y,z\n0,0,0\n1,0,0\n'], 'line.csv');
  const failure = await refusal(tracing.traceMask([{ path: 'line.csv', file: table }], unheard));
  expect([failure.found, failure.expected]).toEqual(['centerlines', 'a mask of vessels']);
  expect(report()).toEqual(before);
});
