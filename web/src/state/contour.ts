/** The contour that the user draws by hand in the section pane. It becomes an edit when the drag ends. */
import { batch, signal } from '@preact/signals';
import type { DrawnContour } from '../core/messages';

/** Whether the section shows the grips of its contour. */
export const isDrawingContour = signal(false);

/** The contour as dragged so far; null while nothing is dragged. */
export const pulledContour = signal<DrawnContour | null>(null);

export function pullContour(to: DrawnContour | null): void {
  pulledContour.value = to;
}

/** Shows or hides the grips. Returns whether they were shown before. */
export function showGrips(isShown: boolean): boolean {
  const before = isDrawingContour.value;
  batch(() => {
    isDrawingContour.value = isShown;
    pulledContour.value = null;
  });
  return before;
}
