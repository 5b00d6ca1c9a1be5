/** A length along a vessel that has a beginning and no end yet: no mark before it has one. */
import { signal } from '@preact/signals';
import type { LineId } from '../core/messages';

/** Where it begins (mm), and on which line. */
export const begunLength = signal<{ readonly line: LineId; readonly at: number } | null>(null);

export function dropLength(): void {
  begunLength.value = null;
}
