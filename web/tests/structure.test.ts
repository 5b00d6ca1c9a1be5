/** Rules for all files of the page: limited length, no import cycles, and only one file that imports WebAssembly. */
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { describe, expect, test } from 'vitest';

const SRC = join(import.meta.dirname, '../src');
const LONGEST = 300;
/** Each room imports only from the rooms before it. */
const ROOMS = 'core input notebook io worker state pane edit measure study output compare views ui'.split(
  ' ',
);
/** Generated files may be longer than the limit. */
const GENERATED = 'core/generated/';

const files = readdirSync(SRC, { recursive: true, encoding: 'utf8' }).filter(
  (name) => /\.tsx?$/.test(name) && !name.startsWith('core/pkg'),
);

function imported(name: string): string[] {
  const text = readFileSync(join(SRC, name), 'utf8');
  const found = [...text.matchAll(/(?:from|import)\s*\(?['"](\.[^'"]*)['"]/g)].map((match) => match[1] ?? '');
  const paths = found.map((path) => normalize(join(dirname(name), path)));
  return paths.flatMap((path) => files.filter((file) => [path, `${path}.ts`, `${path}.tsx`].includes(file)));
}

function circle(graph: ReadonlyMap<string, readonly string[]>): string[] {
  const done = new Set<string>();
  const walk = (name: string, way: string[]): string[] => {
    if (way.includes(name)) {
      return [...way.slice(way.indexOf(name)), name];
    }
    if (done.has(name)) {
      return [];
    }
    for (const next of graph.get(name) ?? []) {
      const found = walk(next, [...way, name]);
      if (found.length > 0) {
        return found;
      }
    }
    done.add(name);
    return [];
  };
  return [...graph.keys()].map((name) => walk(name, [])).find((found) => found.length > 0) ?? [];
}

const textOf = (name: string): string => readFileSync(join(SRC, name), 'utf8');

const signalsIn = (text: string): string[] =>
  [...text.matchAll(/^export const (\w+)\b[^=]*= signal\b/gm)].map((match) => match[1] ?? '');

/** Writes to any of the signals, such as `camera.value = to`. */
const writesIn = (text: string, signals: readonly string[]): string[] =>
  [...text.matchAll(/\b(\w+)\.value\s*(?:[-+*]|\?\?|\|\||&&)?=(?!=)/g)]
    .map((match) => match[1] ?? '')
    .filter((name) => signals.includes(name));

describe('the state of the page', () => {
  const inState = files.filter((name) => name.startsWith('state/'));
  const elsewhere = files.filter((name) => !name.startsWith('state/'));
  const signals = inState.flatMap((name) => signalsIn(textOf(name)));

  test('has signals with one name each', () => {
    expect(signals.length).toBeGreaterThan(50);
    expect([...new Set(signals)]).toEqual(signals);
  });

  test('is kept in the room `state` alone', () => {
    const makes = /import \{[^}]*\bsignal\b[^}]*\} from '@preact\/signals'/;
    expect(elsewhere.filter((name) => makes.test(textOf(name)))).toEqual([]);
    expect(inState.some((name) => makes.test(textOf(name)))).toBe(true);
  });

  test('is changed by its own actions alone', () => {
    const writes = elsewhere.flatMap((name) =>
      writesIn(textOf(name), signals).map((one) => `${name}: ${one}`),
    );
    expect(writes).toEqual([]);
  });

  test('is seen where it is written', () => {
    const text =
      'tool.value = x; store.camera.value ??= y; resets.value += 1; tool.value === z; box.value = 1;';
    expect(writesIn(text, ['tool', 'camera', 'resets'])).toEqual(['tool', 'camera', 'resets']);
    expect(writesIn(inState.map(textOf).join('\n'), signals).length).toBeGreaterThan(50);
  });
});

describe('the files of the page', () => {
  test('are found', () => expect(files.length).toBeGreaterThan(20));

  test.each(files.filter((name) => !name.startsWith(GENERATED)))('%s is short', (name) => {
    expect(readFileSync(join(SRC, name), 'utf8').split('\n').length).toBeLessThanOrEqual(LONGEST);
  });

  test('do not import each other in a cycle', () => {
    expect(circle(new Map(files.map((name) => [name, imported(name)])))).toEqual([]);
  });

  test('lie in rooms that import only from the rooms before them', () => {
    const inRooms = files.filter((name) => name !== 'main.tsx');
    const placeOf = (name: string) => ROOMS.indexOf(name.split(/[/\\]/)[0] ?? '');
    expect(inRooms.filter((name) => placeOf(name) < 0)).toEqual([]);
    const backwards = inRooms.flatMap((name) =>
      imported(name)
        .filter((other) => placeOf(other) > placeOf(name))
        .map((other) => `${name} imports ${other}`),
    );
    expect(backwards).toEqual([]);
  });

  test('a cycle would be detected', () => {
    const graph = new Map([
      ['a', ['b']],
      ['b', ['c']],
      ['c', ['a']],
    ]);
    expect(circle(graph)).toEqual(['a', 'b', 'c', 'a']);
  });

  test('import the engine of the page instead of taking it as a parameter', () => {
    const isTaken = /\bengine\??: (Engine|EngineClient|Asked)\b[^;]*?[,)]/;
    const above = files.filter((name) => !/^(core|io|worker)\b/.test(name));
    expect(above.filter((name) => isTaken.test(readFileSync(join(SRC, name), 'utf8')))).toEqual([]);
    expect(isTaken.test('show(engine: Asked)')).toBe(true);
  });

  test('import WebAssembly in only one file', () => {
    const touching = files.filter((name) => readFileSync(join(SRC, name), 'utf8').includes('/pkg/'));
    expect(touching).toEqual(['core/module.ts']);
  });
});
