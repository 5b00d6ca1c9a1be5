/** The whole vessel of one click as it is shown before it is taken, once the vessels of the scan are known. */
import { computed, effect, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Latest } from '../core/latest';
import type { Vector, WholeVessel } from '../core/messages';
import { document_ } from '../state/history';
import { tool } from '../state/tool';
import { candidate, coming, drawn, first } from './drawing';

/** The place whose whole vessel can be taken: the only one that was clicked of a vessel. */
export const only = computed<Vector | null>(() =>
  tool.value === 'trace' && !drawn.value && coming.value.length === 0
    ? (candidate.value ?? first.value)
    : null,
);

/** The vessel that would be taken; null where none is known. */
export const whole = signal<WholeVessel | null>(null);

/** A first point about which more is asked than its whole vessel: that comes with the answer. */
export const checked = signal<Vector | null>(null);

/** Shows what would be taken from now on; gives what ends it. */
export function followWhole(engine: Asked): () => void {
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
