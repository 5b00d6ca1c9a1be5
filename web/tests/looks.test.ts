import { afterEach, beforeEach, expect, test } from 'vitest';
import type {
  LookRow,
  RegionRow,
  Report,
  SettingRow,
  Settings,
  Started,
  Windows,
} from '../src/core/messages';
import { setSetting } from '../src/state/actions';
import { undo } from '../src/state/history';
import {
  chooseLines,
  chooseLook,
  chooseRegion,
  chooseStent,
  chosenLook,
  chosenRegion,
  isOffered,
  isStentShown,
  lines,
  mayHoldStents,
} from '../src/state/looks';
import * as store from '../src/state/store';

const NONE: Settings = { focus: null, context: 'mida', slab: null };
const look = (name: string, settings: Settings): LookRow => ({
  name,
  words: name,
  sentence: name,
  settings: { ...NONE, ...settings },
});
const [LUMEN, FOCUS, BODY, MIP, SLAB] = [
  look('lumen', {}),
  look('focus', { focus: [2, 6] }),
  look('body', { focus: [-1e6, 0] }),
  look('mip', { focus: [-1e6, 0], context: 'mip' }),
  look('slab', { slab: [10, 'max'] }),
] as const;
const LOOKS = [LUMEN, FOCUS, BODY, MIP, SLAB];
const row = (name: string, value: SettingRow['default']) => ({ name, default: value }) as SettingRow;

const windowsOf = (presets: Windows['presets'], known: Partial<Windows>): Windows => ({
  main: [200, 600],
  contexts: {},
  presets,
  is_hounsfield: false,
  may_hold_stents: false,
  ...known,
});

function open(vessels: number): void {
  store.report.value = {
    volume: null,
    vessels: Array.from({ length: vessels }, (_, line) => ({ line, name: '', length: 1, has_radius: true })),
    windows: null,
  };
}

beforeEach(() => {
  const table = [
    ...Object.entries(NONE).map(([name, value]) => row(name, value)),
    row('silhouettes', true),
    row('silhouette_reach', 10),
  ];
  store.started.value = { table, looks: LOOKS, regions: [] } as unknown as Started;
  open(1);
});

afterEach(() => {
  store.started.value = null;
  store.report.value = null;
  store.settings.value = {};
  store.method.value = 'csr';
});

test('the settings determine which look is shown as chosen', () => {
  expect(chosenLook.value).toBe('lumen');
  for (const chosen of [...LOOKS, ...LOOKS.toReversed()]) {
    chooseLook(chosen);
    expect(chosenLook.value).toBe(chosen.name);
  }
});

test('the size of a focus does not change the look; a slab of another thickness is no look', () => {
  chooseLook(FOCUS);
  setSetting('focus', [12, 6]);
  expect(chosenLook.value).toBe('focus');
  setSetting('slab', [4, 'max']);
  expect(chosenLook.value).toBeNull();
});

test('a look shows the cut surface, and keeps settings that no look contains', () => {
  store.method.value = 'cr';
  setSetting('levels', 3);
  chooseLook(MIP);
  expect(store.method.value).toBe('csr');
  expect(store.settings.value).toEqual({ ...NONE, levels: 3, focus: [-1e6, 0], context: 'mip' });
});

test('without vessels, only looks without a cut are offered, and the context determines the chosen one', () => {
  open(0);
  expect(LOOKS.filter(isOffered)).toEqual([BODY, MIP]);
  expect(chosenLook.value).toBe('body');
  setSetting('context', 'mip');
  expect(chosenLook.value).toBe('mip');
});

test('lines are none, near vessels or all, and can be restored', () => {
  expect(lines.value).toBe('near');
  for (const [wanted, silhouettes, reach] of [
    ['all', true, null],
    ['none', false, 10],
    ['near', true, 10],
  ] as const) {
    chooseLines(wanted);
    expect(lines.value).toBe(wanted);
    expect(store.settings.value).toMatchObject({ silhouettes, silhouette_reach: reach });
  }
});

test('stents are shown in the lumen look and their own window, which can be undone', () => {
  const presets = [
    { name: 'auto', words: 'From the data', window: [200, 600] },
    { name: 'stent', words: 'Stent', window: [400, 1500] },
  ] as const;
  const report = store.report.value as Report;
  store.report.value = { ...report, windows: windowsOf(presets, { may_hold_stents: true }) };
  expect(mayHoldStents.value).toBe(true);
  store.window_.value = [200, 600];
  chooseLook(MIP);
  expect(isStentShown.value).toBe(false);
  chooseStent();
  expect(store.window_.value).toEqual([400, 1500]);
  expect([chosenLook.value, isStentShown.value]).toEqual(['lumen', true]);
  undo();
  expect([chosenLook.value, isStentShown.value]).toEqual(['lumen', false]);
  chooseStent();
  chooseLook(MIP);
  expect(isStentShown.value).toBe(false);
  store.report.value = { ...report, windows: windowsOf(presets, {}) };
  expect(mayHoldStents.value, 'an MRA holds nothing as bright as metal').toBe(false);
});

test('a region selects look, slab and window; the window depends on the unit of the values', () => {
  const presets = [
    { name: 'cta', words: 'CT angiography', window: [300, 900] },
    { name: 'mra', words: 'MR angiography', window: [2037, 1039] },
  ] as const;
  const region = (name: string, settings: Settings): RegionRow => ({
    name,
    words: name,
    sentence: name,
    settings: { ...NONE, ...settings },
    preset: 'cta',
    preset_of_other_units: 'mra',
  });
  const regions = [region('carotid', {}), region('coronary', { slab: [5, 'max'] })];
  store.started.value = { ...(store.started.value as Started), regions };
  const report = store.report.value as Report;
  store.report.value = { ...report, windows: windowsOf(presets, { is_hounsfield: true }) };
  store.window_.value = [1, 2];
  expect(chosenRegion.value).toBeNull();
  chooseRegion('coronary');
  expect([store.window_.value, chosenRegion.value]).toEqual([[300, 900], 'coronary']);
  expect(store.settings.value).toMatchObject({ slab: [5, 'max'] });
  expect(chosenLook.value, 'its slab is thinner than that of the look').toBeNull();
  undo();
  expect([store.window_.value, chosenRegion.value]).toEqual([[1, 2], null]);
  store.report.value = { ...report, windows: windowsOf(presets, {}) };
  chooseRegion('carotid');
  expect([store.window_.value, chosenRegion.value, chosenLook.value]).toEqual([
    [2037, 1039],
    'carotid',
    'lumen',
  ]);
});
