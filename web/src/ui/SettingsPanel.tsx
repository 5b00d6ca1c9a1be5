/** All settings of the turning view, made from the table that the whole of Lumencut shares. */
import type { SettingRow } from '../core/messages';
import { setSetting, settingOf } from '../state/actions';
import { settings, started } from '../state/store';

/** The kinds that have a control here; windows have the strip. */
const KINDS: readonly string[] = ['flag', 'number', 'count', 'choice', 'transfer'];
/** What the toolbar or the view decides. */
const ELSEWHERE: readonly string[] = ['context', 'silhouettes', 'samples', 'context_preview'];

export function SettingsPanel() {
  const rows = (started.value?.table ?? []).filter(
    (row) => KINDS.includes(row.kind) && !ELSEWHERE.includes(row.name),
  );
  const reset = () => {
    settings.value = {};
  };
  return (
    <details class="menu">
      <summary>Settings</summary>
      <div class="menu-body settings">
        {rows.map((row) => (
          <Row key={row.name} row={row} />
        ))}
        <button type="button" onClick={reset}>
          All as at first
        </button>
      </div>
    </details>
  );
}

function Row({ row }: { readonly row: SettingRow }) {
  return (
    <label title={row.sentence}>
      <span>{row.name.replaceAll('_', ' ')}</span>
      <Control row={row} />
      <small>{row.unit ?? ''}</small>
    </label>
  );
}

function Control({ row }: { readonly row: SettingRow }) {
  const value = settingOf(row.name);
  if (row.kind === 'flag') {
    return (
      <input
        type="checkbox"
        checked={Boolean(value)}
        onChange={(event) => setSetting(row.name, event.currentTarget.checked)}
      />
    );
  }
  if (row.choices.length > 0) {
    return (
      <select
        value={String(value ?? '')}
        onChange={(event) => setSetting(row.name, event.currentTarget.value || null)}
      >
        {row.optional && <option value="">{row.open ?? 'none'}</option>}
        {row.choices.map((name) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </select>
    );
  }
  return (
    <input
      class="number"
      type="number"
      min={row.low ?? undefined}
      max={row.high ?? undefined}
      step={row.kind === 'count' ? 1 : 'any'}
      placeholder={row.open ?? ''}
      value={value === null ? '' : String(value)}
      onChange={(event) => changeNumber(row, event.currentTarget.value)}
    />
  );
}

/** Numbers outside their range are brought into it; an empty field is the setting left open. */
function changeNumber(row: SettingRow, text: string): void {
  const number = Number(text);
  if (text.trim() === '') {
    setSetting(row.name, row.default);
  } else if (Number.isFinite(number)) {
    const bounded = Math.min(Math.max(number, row.low ?? number), row.high ?? number);
    setSetting(row.name, row.kind === 'count' ? Math.round(bounded) : bounded);
  }
}
