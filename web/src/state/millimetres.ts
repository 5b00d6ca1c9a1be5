/** Whether lengths are told in mm: where the scan says how far its voxels lie apart, or the reader takes them for 1 mm apart. */
import { computed } from '@preact/signals';
import { change, document_ } from './history';
import { states } from './store';

/** Whether the page tells lengths in mm. */
export const hasMillimetres = computed(() => states.value.spacing || document_.value.isOneMillimetre);

/** Whether these lengths in mm are assumed: the scan does not say, and what is saved tells so. */
export const isMillimetreAssumed = computed(() => !states.value.spacing && document_.value.isOneMillimetre);

/** Takes voxels for 1 mm apart, as a step that can be undone. What is saved tells that they are assumed. */
export function assumeOneMillimetre(): void {
  change('assume 1 mm', { ...document_.value, isOneMillimetre: true });
}
