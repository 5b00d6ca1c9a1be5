/** Checkbox that decides whether reports contain the name of the scan. */
import { isScanNamed, setScanNamed } from '../state/questions';

export function ScanNamed() {
  return (
    <label class="with-name">
      <input
        type="checkbox"
        checked={isScanNamed.value}
        onChange={(event) => setScanNamed(event.currentTarget.checked)}
      />
      include the name of the scan
    </label>
  );
}
