/** Looks: named groups of view settings, which the engine defines. */
import { batch, computed } from '@preact/signals';
import type { LookRow, RegionRow, Settings, SettingValue } from '../core/messages';
import { choosePreset, settingOf } from './actions';
import * as store from './store';

export type Lines = 'none' | 'near' | 'all';

/** Whether a setting is that of a look. For a focus (margin around the vessels), any size matches. */
function agrees(name: string, chosen: SettingValue, own: SettingValue): boolean {
  if (name === 'focus' && Array.isArray(chosen) && Array.isArray(own)) {
    return Number(chosen[0]) < 0 === Number(own[0]) < 0;
  }
  return JSON.stringify(chosen) === JSON.stringify(own);
}

/** Whether a look can be chosen: looks that show the cut need vessels. */
export function isOffered(look: LookRow): boolean {
  return store.hasTree.value || showsNoCut(look);
}

function showsNoCut({ settings: { focus } }: LookRow): boolean {
  return Array.isArray(focus) && Number(focus[0]) < 0;
}

/** The look whose settings are all active; null if there is none. */
export const chosenLook = computed<string | null>(() => {
  const looks = store.started.value?.looks ?? [];
  return looks.find((look) => isOffered(look) && holds(look.settings))?.name ?? null;
});

function holds(settings: Settings): boolean {
  // Without vessels, only the setting `context` is compared.
  const counts = (name: string) => store.hasTree.value || name === 'context';
  return Object.entries(settings).every(([name, own]) => !counts(name) || agrees(name, settingOf(name), own));
}

export function chooseLook(look: Pick<LookRow, 'settings'>): void {
  batch(() => {
    store.method.value = 'csr';
    store.settings.value = { ...store.settings.value, ...look.settings };
  });
}

export const STENT_LOOK = 'lumen';
const STENT_PRESET = 'stent';

/** Whether the scan may be a CT: it is in Hounsfield units, or has values as bright as metal. */
export const mayHaveBone = computed<boolean>(() => store.report.value?.windows?.may_hold_stents ?? false);

export const mayHoldStents = computed<boolean>(() => store.hasTree.value && mayHaveBone.value);

const presetNamed = (wanted: string): number =>
  store.report.value?.windows?.presets.findIndex(({ name }) => name === wanted) ?? -1;

function isWindowOf(preset: string): boolean {
  const window = store.report.value?.windows?.presets[presetNamed(preset)]?.window;
  const [level, width] = store.window_.value;
  return window?.[0] === level && window[1] === width;
}

export const isStentShown = computed<boolean>(
  () => chosenLook.value === STENT_LOOK && isWindowOf(STENT_PRESET),
);

/** Shows the cut in the window for stents. The change of the window is an undo step. */
export function chooseStent(): void {
  const look = store.started.value?.looks.find(({ name }) => name === STENT_LOOK);
  if (look) {
    chooseLook(look);
    choosePreset(presetNamed(STENT_PRESET));
  }
}

const presetOf = (region: RegionRow): string =>
  store.report.value?.windows?.is_hounsfield ? region.preset : region.preset_of_other_units;

/** The body region whose look and window are active; null if there is none. */
export const chosenRegion = computed<string | null>(() => {
  const isShown = (region: RegionRow) => holds(region.settings) && isWindowOf(presetOf(region));
  return store.started.value?.regions.find(isShown)?.name ?? null;
});

/** Applies the look and the window of a body region. The change of the window is an undo step. */
export function chooseRegion(name: string): void {
  const region = store.started.value?.regions.find((one) => one.name === name);
  if (region) {
    chooseLook(region);
    choosePreset(presetNamed(presetOf(region)));
  }
}

export const lines = computed<Lines>(() => {
  if (!settingOf('silhouettes')) {
    return 'none';
  }
  return settingOf('silhouette_reach') === null ? 'all' : 'near';
});

/** Selects which edge lines are drawn. Lines near vessels reach as far as the default setting says. */
export function chooseLines(chosen: Lines): void {
  const row = store.started.value?.table.find(({ name }) => name === 'silhouette_reach');
  store.settings.value = {
    ...store.settings.value,
    silhouettes: chosen !== 'none',
    silhouette_reach: chosen === 'all' ? null : (row?.default ?? null),
  };
}
