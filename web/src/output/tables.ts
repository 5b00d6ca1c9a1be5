/** Saves the measurements of all measured vessels as CSV or JSON. */

import { Failure } from '../core/failure';
import type { MeasuredVessel } from '../core/messages';
import { marksOf } from '../measure/marks';
import { document_ } from '../state/history';
import { isMillimetreAssumed } from '../state/millimetres';
import { profiles } from '../state/profiles';
import * as store from '../state/store';
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

/** The measured vessels in the order of the tree, with the ids that `lumencut measure` would give them. */
function measuredVessels(): MeasuredVessel[] {
  return (store.report.value?.vessels ?? []).flatMap(({ line, name }, number) => {
    const found = profiles.value.get(line);
    const marks = marksOf(document_.value, line);
    return found && 'profile' in found ? [{ id: String(number), name, line, marks }] : [];
  });
}
