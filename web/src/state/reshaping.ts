/** The line of the picked vessel while the user moves or smooths it by hand. It becomes an edit when the drag ends. */
import { batch, signal } from '@preact/signals';
import type { Vector } from '../core/messages';

export const isReshaping = signal(false);

/** The line as changed so far; null while nothing is changed. */
export const reshapedLine = signal<readonly Vector[] | null>(null);

export function showReshaped(points: readonly Vector[] | null): void {
  reshapedLine.value = points;
}

/** Shows or hides the grips. Returns whether they were shown before. */
export function showLineGrips(areShown: boolean): boolean {
  const before = isReshaping.value;
  batch(() => {
    isReshaping.value = areShown;
    reshapedLine.value = null;
  });
  return before;
}
