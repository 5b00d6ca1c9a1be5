/** Measuring starts at the narrowest place, once it is known. */
import { signal } from '@preact/signals';

/** Whether measuring has just opened and its first place is not shown yet. */
export const isArriving = signal(false);
