/** The measured vessels with their marks, as messages to the engine. */
import type { MeasuredVessel } from '../core/messages';
import { document_ } from '../state/history';
import { profiles } from '../state/profiles';
import { report } from '../state/store';
import { marksOf } from './marks';

/** In the order of the tree, with the ids that `lumencut measure` would give them. */
export function measuredVessels(): MeasuredVessel[] {
  return (report.value?.vessels ?? []).flatMap(({ line, name }, number) => {
    const found = profiles.value.get(line);
    const marks = marksOf(document_.value, line);
    return found && 'profile' in found ? [{ id: String(number), name, line, marks }] : [];
  });
}
