/** File names that include the study name. */
import { studyName } from '../state/store';
import { fileName, type Named } from './file-names';

export const studyFileName = (named: Omit<Named, 'scan'>): string =>
  fileName({ ...named, scan: studyName.value });
