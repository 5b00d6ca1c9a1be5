/** Tests of `asking.js` in the Python package, which sends requests from the notebook page to the kernel. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

type Step = readonly (string | number)[];
interface Asked {
  readonly id: string;
  readonly steps: Step[];
  readonly moving: boolean;
}
interface Asker {
  readonly isResting: boolean;
  ask(step: Step): void;
  answered(id: string): number | null;
}

const source = readFileSync(
  join(import.meta.dirname, '../../python/lumencut/notebook/front/asking.js'),
  'utf-8',
);
const Made = new Function(`${source}\nreturn Asker;`)() as new (
  model: { send(content: Asked): void },
  tell: (words: string, isWrong: boolean) => void,
) => Asker;

let sent: Asked[] = [];
let told: string[] = [];
let asker: Asker;

function last(): Asked {
  const asked = sent.at(-1);
  if (!asked) {
    throw new Error('nothing was asked');
  }
  return asked;
}

beforeEach(() => {
  vi.useFakeTimers();
  [sent, told] = [[], []];
  asker = new Made({ send: (content) => sent.push(content) }, (words) => told.push(words));
});
afterEach(() => vi.useRealTimers());

describe('requests of a notebook to its kernel', () => {
  it('one request runs at a time, and later steps are summed', () => {
    asker.ask(['rotate', 1, 2]);
    asker.ask(['rotate', 10, 20]);
    asker.ask(['rotate', 5, 5]);
    asker.ask(['scroll', 'section', 1]);
    asker.ask(['scroll', 'section', 2]);
    asker.ask(['scroll', 'straightened', 1]);
    expect(sent.map(({ steps }) => steps)).toEqual([[['rotate', 1, 2]]]);
    expect(asker.answered('of another view')).toBeNull();
    expect(sent).toHaveLength(1);
    vi.advanceTimersByTime(30);
    expect(asker.answered(last().id)).toBe(30);
    expect(last().steps).toEqual([
      ['rotate', 15, 25],
      ['scroll', 'section', 3],
      ['scroll', 'straightened', 1],
    ]);
  });

  it('steps of several kinds keep their order, and no click is lost', () => {
    asker.ask(['begin']);
    for (const step of [
      ['pan', 1, 1],
      ['zoom', 1.1, 5, 5],
      ['pan', 1, 1],
      ['click', 'vessels', 1, 1],
      ['click', 'vessels', 1, 1],
    ]) {
      asker.ask(step);
    }
    asker.answered(last().id);
    expect(last().steps.map(([name]) => name)).toEqual(['pan', 'zoom', 'pan', 'click', 'click']);
  });

  it('the picture at rest is requested once nothing moves', () => {
    asker.ask(['rotate', 1, 2]);
    expect(last().moving).toBe(true);
    asker.answered(last().id);
    expect(asker.isResting).toBe(false);
    vi.advanceTimersByTime(119);
    expect(sent).toHaveLength(1);
    vi.advanceTimersByTime(1);
    expect(last()).toMatchObject({ steps: [], moving: false });
    asker.answered(last().id);
    expect(asker.isResting).toBe(true);
    vi.advanceTimersByTime(60_000);
    expect(sent).toHaveLength(2);
    expect(told).toEqual([]);
  });

  it('the page says that the kernel is busy, and what to do if it does not answer', () => {
    asker.ask(['rotate', 1, 2]);
    vi.advanceTimersByTime(1499);
    expect(told).toEqual([]);
    vi.advanceTimersByTime(1);
    expect(told.at(-1)).toContain('The kernel is busy');
    vi.advanceTimersByTime(8500);
    expect(told.at(-1)).toContain('run the cell again');
    expect(told).toHaveLength(2);
    // An answer that arrives late is shown, and one that is lost blocks nothing.
    expect(asker.answered(last().id)).toBeNull();
    asker.ask(['rotate', 1, 2]);
    expect(sent).toHaveLength(2);
    asker.ask(['rotate', 3, 4]);
    asker.answered(last().id);
    expect(last().steps).toEqual([['rotate', 3, 4]]);
  });
});
