/** Pane that shows the picked vessel as straightened CPR or in another reformation. */
import { chooseReformation, REFORMATIONS, type ReformationKind, reformationKind } from '../state/reformation';
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

export function ReformationChoice() {
  return (
    <select
      class="reformation-choice"
      aria-label="Reformation"
      value={reformationKind.value}
      onChange={(event) => chooseReformation(event.currentTarget.value as ReformationKind)}
    >
      {REFORMATIONS.map(([kind, words]) => (
        <option key={kind} value={kind}>
          {words}
        </option>
      ))}
    </select>
  );
}
