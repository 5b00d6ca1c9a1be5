/** Preview of the whole vessel at a single clicked point. */

import { computed, effect, signal } from '@preact/signals';
import { Latest } from '../core/latest';
import type { Vector, WholeVessel } from '../core/messages';
import { document_ } from '../state/history';
import { tool } from '../state/tool';
import { engine } from '../worker/engine';
import { candidate, coming, drawn, first } from './drawing';

/** The clicked point if the vessel has no other; the whole vessel there can be traced. */
export const only = computed<Vector | null>(() =>
  tool.value === 'trace' && !drawn.value && coming.value.length === 0
    ? (candidate.value ?? first.value)
    : null,
);

export const whole = signal<WholeVessel | null>(null);

/** A first point whose check has already returned the whole vessel. */
export const checked = signal<Vector | null>(null);

/** Keeps the preview up to date. Returns a function that stops this. */
export function followWhole(): () => void {
  const latest = new Latest();
  return effect(() => {
    const click = only.value;
    const { vessels } = document_.value;
    const isChecked = click !== null && click === checked.peek();
    checked.value = null;
    whole.value = null;
    if (click && !isChecked) {
      latest.run(async () => {
        const found = await engine.ask('whole_vessel', { click, vessels }).catch(() => null);
        whole.value = only.value === click ? found : whole.value;
      });
    }
  });
}
