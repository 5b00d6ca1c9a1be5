/** The menu "Research": methods, contexts, and all settings in the engine's table. */
import type { Method, SettingRow, Slices } from '../core/messages';
import { VIEW_METHODS } from '../core/method-names';
import { SlabField } from '../pane/SlabField';
import { setSetting, settingOf } from '../state/actions';
import { chooseMethod, method, resetSettings, started } from '../state/store';
import { keepWithin, useClosing } from './closing-menu';
import { TransferEditor } from './TransferEditor';

const CONTEXTS: readonly (readonly [string, string])[] = [
  ['mida', 'MIDA'],
  ['dvr', 'DVR'],
  ['mip', 'MIP'],
  ['minip', 'MinIP'],
  ['average', 'Average'],
  ['', 'None'],
];

/** Kinds of settings that have a control in this menu. Windows are set in the window strip. */
const KINDS: readonly string[] = ['flag', 'number', 'count', 'choice', 'transfer'];
/** Settings that have a control elsewhere, or that the view determines. */
const ELSEWHERE: readonly string[] = ['context', 'samples', 'edge_samples', 'context_preview'];

export function ResearchMenu() {
  const rows = (started.value?.table ?? []).filter(
    (row) => KINDS.includes(row.kind) && !ELSEWHERE.includes(row.name),
  );
  return (
    <details class="menu" onToggle={keepWithin} ref={useClosing()}>
      <summary>Research</summary>
      <div class="menu-body settings">
        <MethodChoice />
        <ContextChoice />
        <Slab />
        {rows.map((row) =>
          row.kind === 'transfer' ? (
            <TransferEditor key={row.name} row={row} />
          ) : (
            <Row key={row.name} row={row} />
          ),
        )}
        <button type="button" onClick={resetSettings}>
          Reset
        </button>
      </div>
    </details>
  );
}

function MethodChoice() {
  return (
    <label>
      <span>Method</span>
      <select value={method.value} onChange={(event) => chooseMethod(event.currentTarget.value as Method)}>
        {VIEW_METHODS.map(([name, words]) => (
          <option key={name} value={name}>
            {words}
          </option>
        ))}
      </select>
    </label>
  );
}

function ContextChoice() {
  return (
    <label>
      <span>Context</span>
      <select
        value={String(settingOf('context') ?? '')}
        onChange={(event) => setSetting('context', event.currentTarget.value || null)}
      >
        {CONTEXTS.map(([name, words]) => (
          <option key={name} value={name}>
            {words}
          </option>
        ))}
      </select>
    </label>
  );
}

function Slab() {
  const slab = settingOf('slab') as Slices['slab'];
  return <SlabField slab={slab} choose={(chosen) => setSetting('slab', chosen)} />;
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

/** Sets a number, limited to its range; an empty field restores the default. */
function changeNumber(row: SettingRow, text: string): void {
  const number = Number(text);
  if (text.trim() === '') {
    setSetting(row.name, row.default);
  } else if (Number.isFinite(number)) {
    const bounded = Math.min(Math.max(number, row.low ?? number), row.high ?? number);
    setSetting(row.name, row.kind === 'count' ? Math.round(bounded) : bounded);
  }
}
