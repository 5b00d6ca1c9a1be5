/** Which reformation the pane of the picked vessel shows. */
import { REFORMATIONS, type ReformationKind, reformationKind } from '../state/reformation';

export function ReformationChoice() {
  return (
    <select
      aria-label="Reformation"
      value={reformationKind.value}
      onChange={(event) => {
        reformationKind.value = event.currentTarget.value as ReformationKind;
      }}
    >
      {REFORMATIONS.map(([kind, words]) => (
        <option key={kind} value={kind}>
          {words}
        </option>
      ))}
    </select>
  );
}
