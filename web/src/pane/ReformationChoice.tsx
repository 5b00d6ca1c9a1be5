/** Which reformation the pane of the picked vessel shows: it stands in the place of the pane's title. */
import { REFORMATIONS, type ReformationKind, reformationKind } from '../state/reformation';

export function ReformationChoice() {
  return (
    <select
      class="reformation-choice"
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
