/** A length along a vessel that the user has begun and not ended yet. */
import { signal } from '@preact/signals';
import type { LineId } from '../core/messages';

/** The line of the vessel, and the arc length at which the length begins (mm). */
export const begunLength = signal<{ readonly line: LineId; readonly at: number } | null>(null);

export function dropLength(): void {
  begunLength.value = null;
}
