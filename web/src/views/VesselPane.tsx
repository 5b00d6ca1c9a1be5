/** Pane that shows the picked vessel as straightened CPR or in another reformation. */
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
