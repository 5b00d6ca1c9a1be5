/** Names of files that tell their scan as the study is called. */
import { studyName } from '../state/store';
import { fileName, type Named } from './file-names';

/** As `fileName`, with the name of the study as that of the scan. */
export const studyFileName = (named: Omit<Named, 'scan'>): string =>
  fileName({ ...named, scan: studyName.value });
