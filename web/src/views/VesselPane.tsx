/** The pane of the picked vessel: its straightened CPR, or the reformation that was chosen in its place. */
import { ReformationChoice } from '../pane/ReformationChoice';
import { reformationKind } from '../state/reformation';
import { CprView } from './CprView';
import { ReformedView } from './ReformedView';

export function VesselPane() {
  const kind = reformationKind.value;
  return (
    <>
      {kind === 'cpr' ? <CprView /> : <ReformedView key={kind} kind={kind} />}
      <ReformationChoice />
    </>
  );
}
