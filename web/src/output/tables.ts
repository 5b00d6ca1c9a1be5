/** The numbers of measured vessels as files. */
import { Failure } from '../core/failure';
import type { MeasuredVessel } from '../core/messages';
import { engine } from '../core/shared';
import { document_ } from '../edit/history';
import { profiles } from '../measure/profiles';
import { marksOf } from '../measure/vessels';
import * as store from '../state/store';
import { saveAs } from './pictures';

/** Saves the table or the JSON of all vessels that were measured. */
export async function saveNumbers(kind: 'csv' | 'json'): Promise<void> {
  const vessels = measuredVessels();
  if (vessels.length === 0) {
    throw new Failure(
      'picture',
      kind,
      'no vessel that is measured',
      'one',
      'press m to measure the picked one',
    );
  }
  const text = await (kind === 'csv'
    ? engine.ask('profiles_csv', vessels)
    : engine.ask('profiles_json', vessels));
  const type = kind === 'csv' ? 'text/csv' : 'application/json';
  saveAs(new Blob([text], { type }), `lumencut-profile.${kind}`);
}

/** The vessels that were measured, in the order of the tree; their ids are those of `lumencut measure`. */
function measuredVessels(): MeasuredVessel[] {
  return (store.report.value?.vessels ?? []).flatMap(({ line, name }, number) => {
    const found = profiles.value.get(line);
    const marks = marksOf(document_.value, line);
    return found && 'profile' in found ? [{ id: String(number), name, line, marks }] : [];
  });
}
