/** The whole vessel of one click: shown once the vessels of the scan are known, and taken by Enter, a double click or its button. */
import { computed, effect, signal } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Latest } from '../core/latest';
import type { Vector, WholeVessel } from '../core/messages';
import { document_ } from '../state/history';
import { tool } from '../state/tool';
import { commit, refusal } from './committing';
import { candidate, coming, drawn, first, isDrawing } from './drawing';
import { endVessel } from './pointing';
import { toPick } from './shown';

/** The place whose whole vessel can be taken: the only one that was clicked of a vessel. */
export const only = computed<Vector | null>(() =>
  tool.value === 'trace' && !drawn.value && coming.value.length === 0
    ? (candidate.value ?? first.value)
    : null,
);

/** The vessel that would be taken; null where none is known. */
export const whole = signal<WholeVessel | null>(null);

/** Shows what would be taken from now on; gives what ends it. */
export function followWhole(engine: Asked): () => void {
  const latest = new Latest();
  return effect(() => {
    const click = only.value;
    const { vessels } = document_.value;
    whole.value = null;
    if (click) {
      latest.run(async () => {
        const found = await engine.ask('whole_vessel', { click, vessels }).catch(() => null);
        whole.value = only.value === click ? found : whole.value;
      });
    }
  });
}

/**
 * Takes the whole vessel of the point that was clicked; says whether there was such a point. It stays where none is found and a
 * second point would help; one in a vessel that there is already is forgotten.
 */
export function takeWhole(engine: Asked): boolean {
  const click = only.value;
  if (click) {
    endVessel();
    void commit(engine, { kind: 'add_whole_vessel', click }).then((edited) => {
      toPick.value = edited?.added[0] ?? toPick.value;
      const isLeft = edited === null && refusal.value?.failure.advice !== '';
      first.value = isLeft && !isDrawing.value && tool.value === 'trace' ? click : first.value;
    });
  }
  return click !== null;
}
