/** When measuring is opened, the section moves to the narrowest place once it is known. */
import { signal } from '@preact/signals';

/** Whether measuring was opened, and the section has not moved to the narrowest place yet. */
export const isArriving = signal(false);
