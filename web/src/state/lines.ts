/** Points and radii of the centerlines, to draw them over the views. */

import { effect, signal } from '@preact/signals';
import { Failure } from '../core/failure';
import type { LineContent, LineId, NumberedLine } from '../core/messages';
import { length, subtract } from '../core/vectors';
import { engine } from '../worker/engine';
import { answered } from './edit-queue';
import { document_ } from './history';
import { problem } from './store';

/** Contents by line number; they never change. Emptied when the study closes. */
export const contents = signal<ReadonlyMap<LineId, LineContent>>(new Map());

const asked = new Set<LineId>();

/** Loads each line that is added to the document. Returns a function that stops this. */
export function followLines(): () => void {
  return effect(() => {
    const lines = document_.value.vessels.map((vessel) => vessel.line);
    if (lines.length === 0) {
      return;
    }
    take(answered.value?.lines ?? [], lines);
    const missing = lines.filter((line) => !asked.has(line));
    if (missing.length > 0) {
      void load(missing);
    }
  });
}

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

async function load(lines: readonly LineId[]): Promise<void> {
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
    // If the study was closed meanwhile, its lines are gone.
    const isAsked = lines.some((line) => asked.has(line));
    for (const line of lines) {
      asked.delete(line);
    }
    problem.value = isAsked ? Failure.of(error) : problem.value;
  }
}

export function forgetLines(): void {
  asked.clear();
  contents.value = new Map();
}

/** Length of a centerline (mm); 0 until it is loaded. */
export function lengthOf(line: LineId): number {
  const points = contents.value.get(line)?.points ?? [];
  const step = (n: number) => {
    const [from, to] = [points[n - 1], points[n]];
    return from && to ? length(subtract(to, from)) : 0;
  };
  return points.reduce((sum, _, n) => sum + step(n), 0);
}
