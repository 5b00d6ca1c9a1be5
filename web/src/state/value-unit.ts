import { report } from './store';

/** `HU`, or the statement that no unit is known. */
export const valueUnit = (): string => (report.value?.windows?.is_hounsfield ? 'HU' : '(no unit stated)');
