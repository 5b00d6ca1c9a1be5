/** Saves the measurements of all measured vessels as CSV or JSON. */

import { Failure } from '../core/failure';
import { measuredVessels } from '../measure/measured-vessels';
import { isMillimetreAssumed } from '../state/millimetres';
import { engine } from '../worker/engine';
import { studyFileName } from './file-names';
import { saveAs } from './pictures';

export async function saveNumbers(kind: 'csv' | 'json'): Promise<void> {
  const vessels = measuredVessels();
  if (vessels.length === 0) {
    throw new Failure(
      'picture',
      kind,
      'no measured vessel',
      'a measured vessel',
      'press m to measure the picked vessel',
    );
  }
  const asked = { vessels, is_millimetre_assumed: isMillimetreAssumed.value };
  const text = await (kind === 'csv'
    ? engine.ask('profiles_csv', asked)
    : engine.ask('profiles_json', asked));
  const type = kind === 'csv' ? 'text/csv' : 'application/json';
  saveAs(new Blob([text], { type }), studyFileName({ content: 'profile', ending: kind }));
}
