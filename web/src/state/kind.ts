/** What the tracing tools look for, and the words for it. */
import { computed } from '@preact/signals';
import { document_ } from './history';
import { report } from './store';

interface Words {
  readonly one: string;
  readonly several: string;
  /** How lumen compares with the tissue around it. */
  readonly brighter: string;
  readonly brightest: string;
}

const VESSELS: Words = { one: 'vessel', several: 'vessels', brighter: 'brighter', brightest: 'brightest' };
const DARK = { brighter: 'darker', brightest: 'darkest' };
const AIRWAYS: Words = { one: 'airway', several: 'airways', ...DARK };
const LUMENS: Words = { one: 'dark lumen', several: 'dark lumens', ...DARK };

export const isDark = computed<boolean>(() => document_.value.dark);

/** In Hounsfield units, dark lumens are mostly airways. */
export const kind = computed<Words>(() => {
  const dark = report.value?.windows?.is_hounsfield ? AIRWAYS : LUMENS;
  return isDark.value ? dark : VESSELS;
});

export const findAllTitle = (): string =>
  `Finds all ${kind.value.several} that are ${kind.value.brighter} than the surrounding tissue`;
