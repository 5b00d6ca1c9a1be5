/** Whether lengths are in mm: the scan states its voxel spacing, or the user assumes voxels of 1 mm. */
import { computed } from '@preact/signals';
import { change, document_ } from './history';
import { states } from './store';

export const hasMillimetres = computed(() => states.value.spacing || document_.value.isOneMillimetre);

/** Whether the user assumed voxels of 1 mm; saved files then state this. */
export const isMillimetreAssumed = computed(() => !states.value.spacing && document_.value.isOneMillimetre);

export function assumeOneMillimetre(): void {
  change('assume 1 mm', { ...document_.value, isOneMillimetre: true });
}
