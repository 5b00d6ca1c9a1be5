/** Names of the visualisation and stenosis methods in menu order; a test compares them with the engine's. */
import type { Method, StenosisMethod } from './messages';

export const VIEW_METHODS: readonly (readonly [Method, string])[] = [
  ['csr', 'CSR'],
  ['csr-paper', 'CSR (paper)'],
  ['cr', 'CR'],
  ['mpcpr', 'mpCPR'],
];

export const STENOSIS_METHODS: readonly (readonly [StenosisMethod, string])[] = [
  ['nascet', 'NASCET'],
  ['ecst', 'ECST'],
  ['area', 'area'],
];
