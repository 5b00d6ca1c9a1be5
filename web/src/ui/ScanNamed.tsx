/** Checkbox that decides whether reports contain the name of the scan. */
import { isScanNamed } from '../output/report';

export function ScanNamed() {
  return (
    <label class="with-name">
      <input
        type="checkbox"
        checked={isScanNamed.value}
        onChange={(event) => {
          isScanNamed.value = event.currentTarget.checked;
        }}
      />
      include the name of the scan
    </label>
  );
}
