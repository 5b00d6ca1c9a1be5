/** Rulers: straight distances between two points that the user has clicked. */
import { signal } from '@preact/signals';
import type { Vector } from '../core/messages';
import { length, subtract } from '../core/vectors';
import type { Document, Ruler } from './document';
import { change, document_, endPreview, preview } from './history';
import { tool } from './tool';

export const firstEnd = signal<Vector | null>(null);

export function setRulerPoint(point: Vector): void {
  const from = firstEnd.value;
  if (from === null) {
    firstEnd.value = point;
    return;
  }
  firstEnd.value = null;
  const document = document_.value;
  change('measure a distance', { ...document, rulers: [...document.rulers, { from, to: point }] });
  tool.value = 'look';
}

export function toggleRuler(): void {
  firstEnd.value = null;
  tool.value = tool.value === 'ruler' ? 'look' : 'ruler';
}

export function putRulerAway(): void {
  firstEnd.value = null;
  if (tool.value === 'ruler') {
    tool.value = 'look';
  }
}

export const rulerLength = ({ from, to }: Ruler): number => length(subtract(to, from));

export type End = 'from' | 'to';

let begun: Document | null = null;

export function beginRulerMove(): void {
  begun = document_.value;
}

export function moveRuler(number: number, end: End, point: Vector): void {
  const document = document_.value;
  if (begun && document.rulers[number]) {
    const rulers = document.rulers.map((ruler, n) => (n === number ? { ...ruler, [end]: point } : ruler));
    preview({ ...document, rulers });
  }
}

export function endRulerMove(): void {
  if (begun) {
    endPreview('move the end of a ruler', begun);
    begun = null;
  }
}

export function putRulerBack(): void {
  if (begun) {
    preview(begun);
    begun = null;
  }
}

export function removeRuler(number: number): void {
  const document = document_.value;
  change('remove a ruler', { ...document, rulers: document.rulers.filter((_, n) => n !== number) });
}
