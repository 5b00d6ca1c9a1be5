/** An unfinished length along a vessel. */
import { signal } from '@preact/signals';
import type { LineId } from '../core/messages';

/** Start (mm) and line. */
export const begunLength = signal<{ readonly line: LineId; readonly at: number } | null>(null);

export function dropLength(): void {
  begunLength.value = null;
}
