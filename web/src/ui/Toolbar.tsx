/** The bar at the top: tracing, measuring and saving; method, context, silhouettes, slab, presets, layout. */

import { engine } from '../client/shared';
import type { Method } from '../core/messages';
import { VIEW_METHODS } from '../core/method-names';
import { isListOpen, isTracing } from '../edit/mode';
import { performAny } from '../edit/performing';
import { perform, setSetting, settingOf, showLayout } from '../state/actions';
import * as store from '../state/store';
import { leave } from '../study/leaving';
import { close } from '../study/study';
import { FocusControl } from './FocusControl';
import { MeasureButton } from './MeasureButton';
import { OpenMore } from './OpenButtons';
import { SaveMenu } from './SaveMenu';
import { SettingsPanel } from './SettingsPanel';
import { WindowStrip } from './WindowStrip';

const CONTEXTS: readonly (readonly [string, string])[] = [
  ['mida', 'MIDA'],
  ['dvr', 'DVR'],
  ['mip', 'MIP'],
  ['minip', 'MinIP'],
  ['average', 'Average'],
  ['', 'None'],
];
const LAYOUT_NAMES: Readonly<Record<store.Layout, string>> = {
  one: 'One',
  two: 'Two',
  four: 'Four',
  strip: 'With strip',
  measure: 'Measure',
};

export function Toolbar() {
  const slab = settingOf('slab');
  return (
    <header class="toolbar">
      <strong class="brand">Lumencut</strong>
      <VesselButtons />
      <MeasureButton />
      <SaveMenu />
      <label>
        Method
        <select
          value={store.method.value}
          onChange={(event) => {
            store.method.value = event.currentTarget.value as Method;
          }}
        >
          {VIEW_METHODS.map(([name, words]) => (
            <option key={name} value={name}>
              {words}
            </option>
          ))}
        </select>
      </label>
      <label>
        Context
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
      <FocusControl />
      <label>
        <input
          type="checkbox"
          checked={Boolean(settingOf('silhouettes'))}
          onChange={(event) => setSetting('silhouettes', event.currentTarget.checked)}
        />
        Silhouettes
      </label>
      <label>
        Slab
        <input
          class="number"
          type="number"
          min="0"
          max="100"
          step="1"
          value={Array.isArray(slab) ? String(slab[0]) : '0'}
          onChange={(event) => {
            const thickness = Number(event.currentTarget.value);
            setSetting('slab', thickness > 0 ? [thickness, 'max'] : null);
          }}
        />
        mm
      </label>
      <WindowStrip />
      <label>
        Layout
        <select
          value={store.layout.value}
          onChange={(event) => showLayout(event.currentTarget.value as store.Layout)}
        >
          {store.LAYOUTS.map((name) => (
            <option key={name} value={name}>
              {LAYOUT_NAMES[name]}
            </option>
          ))}
        </select>
      </label>
      <SettingsPanel />
      <span class="spring" />
      <OpenMore />
      <button type="button" onClick={() => perform(engine, 'help')} aria-label="Keys and mouse">
        ?
      </button>
      <button type="button" onClick={() => void leave(() => close(engine))} aria-label="Close the scan">
        Close
      </button>
    </header>
  );
}

/** Tracing vessels, and the list of them. */
function VesselButtons() {
  if (!store.hasVolume.value) {
    return null;
  }
  return (
    <>
      <button
        type="button"
        class="tool"
        aria-pressed={isTracing()}
        onClick={() => performAny(engine, 'trace')}
        title="Trace vessels by clicks (t)"
      >
        Trace vessels
      </button>
      <button
        type="button"
        class="tool"
        aria-pressed={isListOpen.value}
        onClick={() => performAny(engine, 'vessels')}
        title="List of the vessels (v)"
      >
        Vessels
      </button>
    </>
  );
}
