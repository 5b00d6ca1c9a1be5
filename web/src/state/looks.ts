/** Looks: named groups of settings from the core's table. */
import { batch, computed } from '@preact/signals';
import type { LookRow, RegionRow, Settings, SettingValue } from '../core/messages';
import { choosePreset, settingOf } from './actions';
import * as store from './store';

export type Lines = 'none' | 'near' | 'all';

/** Whether a setting matches a look; the size of a focus is free. */
function agrees(name: string, chosen: SettingValue, own: SettingValue): boolean {
  if (name === 'focus' && Array.isArray(chosen) && Array.isArray(own)) {
    return Number(chosen[0]) < 0 === Number(own[0]) < 0;
  }
  return JSON.stringify(chosen) === JSON.stringify(own);
}

/** Whether a look is useful; cuts need vessels. */
export function isOffered(look: LookRow): boolean {
  return store.hasTree.value || showsNoCut(look);
}

function showsNoCut({ settings: { focus } }: LookRow): boolean {
  return Array.isArray(focus) && Number(focus[0]) < 0;
}

/** The look that matches all settings; null if none does. */
export const chosenLook = computed<string | null>(() => {
  const looks = store.started.value?.looks ?? [];
  return looks.find((look) => isOffered(look) && holds(look.settings))?.name ?? null;
});

function holds(settings: Settings): boolean {
  // Without vessels, only the context matters.
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

/** Whether the scan may contain stents: in Hounsfield units, with values as bright as metal. */
export const mayHoldStents = computed<boolean>(
  () => store.hasTree.value && (store.report.value?.windows?.may_hold_stents ?? false),
);

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

/** Shows the cut in the stent window; the window is an undo step. */
export function chooseStent(): void {
  const look = store.started.value?.looks.find(({ name }) => name === STENT_LOOK);
  if (look) {
    chooseLook(look);
    choosePreset(presetNamed(STENT_PRESET));
  }
}

const presetOf = (region: RegionRow): string =>
  store.report.value?.windows?.is_hounsfield ? region.preset : region.preset_of_other_units;

/** The region whose look and window are active; null if none. */
export const chosenRegion = computed<string | null>(() => {
  const isShown = (region: RegionRow) => holds(region.settings) && isWindowOf(presetOf(region));
  return store.started.value?.regions.find(isShown)?.name ?? null;
});

/** Applies the look and window of a region; the window is an undo step. */
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

/** Selects the edge lines; the reach of those near vessels is the default. */
export function chooseLines(chosen: Lines): void {
  const row = store.started.value?.table.find(({ name }) => name === 'silhouette_reach');
  store.settings.value = {
    ...store.settings.value,
    silhouettes: chosen !== 'none',
    silhouette_reach: chosen === 'all' ? null : (row?.default ?? null),
  };
}
