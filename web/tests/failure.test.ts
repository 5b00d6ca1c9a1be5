import { expect, test } from 'vitest';
import { CRASH, crashed, Failure } from '../src/core/failure';

const FAILURE = new Failure('format', 'the file', 'no voxels', 'a volume', 'choose another file');

test('the message states what was found, what was expected, and the remedy', () => {
  expect(FAILURE.message).toBe('the file: found no voxels; expected a volume; choose another file');
  expect(new Failure('a', 'b', 'c', 'd').message).toBe('b: found c; expected d');
});

test('a failure stays the same between worker and page', () => {
  expect(Failure.of(new Error(FAILURE.text))).toEqual(FAILURE);
  expect(Failure.of(FAILURE.text)).toEqual(FAILURE);
  expect(Failure.of(FAILURE)).toBe(FAILURE);
});

test('its position and the value there stay the same too', () => {
  const failure = new Failure('tracing', 'points', 'no lumen', 'lumen', '', {
    place: [1, -2, 3.5],
    value: 0,
  });
  expect(Failure.of(failure.text)).toEqual(failure);
  expect([failure.place, failure.value]).toEqual([[1, -2, 3.5], 0]);
  expect([FAILURE.place, FAILURE.value]).toEqual([null, null]);
});

test('a crash of the module is recognised, also after the worker reported it to the page', () => {
  const crash = Failure.of(new WebAssembly.RuntimeError('memory access out of bounds'));
  expect([crash.kind, crash.found]).toEqual([CRASH, 'a crash: memory access out of bounds']);
  expect(crash.mending).toContain('save the session');
  expect(Failure.of(new Error(crash.text))).toEqual(crash);
  expect(Failure.of(new RangeError('too long')).kind).toBe('unexpected');
});

test('a crash without room to grow says that memory is short', () => {
  const crash = crashed('unreachable', 288 * 2 ** 20);
  expect(crash.found).toBe('a crash, probably because memory is short: 288 MiB are in use');
  expect(crash.mending).toContain('close other pages');
  expect(Failure.of(crash.text)).toEqual(crash);
});

test('remedies follow the advice, in the words of the page', () => {
  const mends = [{ name: 'fill_gaps', values: [] }] as const;
  const failure = new Failure('format', 'the file', '1 missing slice', 'slices', 'add it', { mends });
  expect(failure.mending).toBe('add it, or interpolate the missing slices');
  expect(failure.message).toBe(
    'the file: found 1 missing slice; expected slices; add it, or interpolate the missing slices',
  );
  expect([failure.isMendedBy('fill_gaps'), failure.isMendedBy('bridge')]).toEqual([true, false]);
  expect(Failure.of(failure.text)).toEqual(failure);
});

test('a stopped request is an interruption, whatever its text', () => {
  const stop = new AbortController();
  stop.abort();
  expect(Failure.of(stop.signal.reason).kind).toBe('interrupted');
  expect(Failure.of(new DOMException('The connection was aborted', 'NetworkError')).kind).toBe('unexpected');
});

test.each([new Error('out of paper'), 'text', 7, null, undefined, '{"kind":1}', '[]', {}])(
  'anything else that is thrown is unexpected, in its own words: %o',
  (thrown) => {
    const failure = Failure.of(thrown);
    expect(failure.kind).toBe('unexpected');
    expect(failure.advice).toContain('reload');
  },
);
