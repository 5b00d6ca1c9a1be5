/** Menu that selects the reformation of the picked vessel; it takes the place of the pane title. */
import { chooseReformation, REFORMATIONS, type ReformationKind, reformationKind } from '../state/reformation';

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
