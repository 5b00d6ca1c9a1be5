/** The content of the document's lines, for what is drawn over the views. */
import { effect, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Failure } from '../core/failure';
import type { LineContent, LineId, NumberedLine } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { document_ } from '../state/history';
import { problem } from '../state/store';
import { answered } from './committing';

/** By the numbers of the lines; lines never change. Those of a study that was closed are forgotten. */
export const contents = signal<ReadonlyMap<LineId, LineContent>>(new Map());

const asked = new Set<LineId>();

/** Loads the content of lines as they come into the document; gives what ends it. */
export function followLines(engine: Asked): () => void {
  return effect(() => {
    const lines = document_.value.vessels.map((vessel) => vessel.line);
    if (lines.length === 0) {
      return;
    }
    take(answered.value?.lines ?? [], lines);
    const missing = lines.filter((line) => !asked.has(line));
    if (missing.length > 0) {
      void load(engine, missing);
    }
  });
}

/** Takes over the lines that came with an edit. */
function take(given: readonly NumberedLine[], wanted: readonly LineId[]): void {
  const missing = given.filter(({ line }) => wanted.includes(line) && !asked.has(line));
  if (missing.length > 0) {
    for (const { line } of missing) {
      asked.add(line);
    }
    contents.value = new Map([
      ...contents.peek(),
      ...missing.map(({ line, content }) => [line, content] as const),
    ]);
  }
}

async function load(engine: Asked, lines: readonly LineId[]): Promise<void> {
  for (const line of lines) {
    asked.add(line);
  }
  try {
    const found = await Promise.all(lines.map((line) => engine.ask('line', { line })));
    contents.value = new Map([
      ...contents.value,
      ...found.map((content, n) => [lines[n] ?? -1, content] as const),
    ]);
  } catch (error) {
    // Lines of a study that is closed meanwhile were forgotten.
    const isAsked = lines.some((line) => asked.has(line));
    for (const line of lines) {
      asked.delete(line);
    }
    problem.value = isAsked ? Failure.of(error) : problem.value;
  }
}

/** Another study has lines of its own. */
export function forgetLines(): void {
  asked.clear();
  contents.value = new Map();
}

/** The length of a line (mm); 0 where it is not loaded yet. */
export function lengthOf(line: LineId): number {
  const points = contents.value.get(line)?.points ?? [];
  const step = (n: number) => {
    const [from, to] = [points[n - 1], points[n]];
    return from && to ? length(subtract(to, from)) : 0;
  };
  return points.reduce((sum, _, n) => sum + step(n), 0);
}
