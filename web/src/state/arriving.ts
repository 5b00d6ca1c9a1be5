/** Measuring begins at the place that matters, once that is known. */
import { signal } from '@preact/signals';

/** Whether measuring was opened, and its first place is still to be shown. */
export const isArriving = signal(false);
