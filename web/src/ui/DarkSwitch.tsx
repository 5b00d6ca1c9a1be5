/** Switch of the tracing tools between vessels and dark lumens. */
import { traceDark } from '../edit/dark';
import { isDark } from '../state/kind';

export function DarkSwitch() {
  return (
    <label title="Traces lumens that are darker than the tissue around them, and shows the smallest value along each ray. Lines traced before stay as they are">
      <input
        type="checkbox"
        checked={isDark.value}
        onChange={(event) => void traceDark(event.currentTarget.checked)}
      />
      Dark lumens (airways)
    </label>
  );
}
