/** The looks: several settings under one name, as the table of the core says what each of them chooses. */
import { batch, computed } from '@preact/signals';
import type { LookRow, RegionRow, Settings, SettingValue } from '../core/messages';
import { choosePreset, settingOf } from './actions';
import * as store from './store';

/** Which lines are drawn where the cut leaps: none, those near a vessel, or all. */
export type Lines = 'none' | 'near' | 'all';

/** The setting that a look chooses; how far a focus reaches is left to the reader. */
function agrees(name: string, chosen: SettingValue, own: SettingValue): boolean {
  if (name === 'focus' && Array.isArray(chosen) && Array.isArray(own)) {
    return Number(chosen[0]) < 0 === Number(own[0]) < 0;
  }
  return JSON.stringify(chosen) === JSON.stringify(own);
}

/** Whether a look shows something: without vessels there is nothing to cut. */
export function isOffered(look: LookRow): boolean {
  return store.hasTree.value || showsNoCut(look);
}

function showsNoCut({ settings: { focus } }: LookRow): boolean {
  return Array.isArray(focus) && Number(focus[0]) < 0;
}

/** The look that all settings agree with; null where one of them was chosen apart. */
export const chosenLook = computed<string | null>(() => {
  const looks = store.started.value?.looks ?? [];
  return looks.find((look) => isOffered(look) && holds(look.settings))?.name ?? null;
});

/** Whether settings are those that are chosen. */
function holds(settings: Settings): boolean {
  // Without vessels no focus counts, and the context is all there is.
  const counts = (name: string) => store.hasTree.value || name === 'context';
  return Object.entries(settings).every(([name, own]) => !counts(name) || agrees(name, settingOf(name), own));
}

/** Shows vessels and body by a look. */
export function chooseLook(look: Pick<LookRow, 'settings'>): void {
  batch(() => {
    store.method.value = 'csr';
    store.settings.value = { ...store.settings.value, ...look.settings };
  });
}

/** The look whose cut stents are read in. */
export const STENT_LOOK = 'lumen';
const STENT_PRESET = 'stent';

/** Whether a look for stents shows anything: in Hounsfield units, and where something is as bright as metal. */
export const mayHoldStents = computed<boolean>(
  () => store.hasTree.value && (store.report.value?.windows?.may_hold_stents ?? false),
);

/** The number of a window among those that have a name; -1 where there is none. */
const presetNamed = (wanted: string): number =>
  store.report.value?.windows?.presets.findIndex(({ name }) => name === wanted) ?? -1;

function isWindowOf(preset: string): boolean {
  const window = store.report.value?.windows?.presets[presetNamed(preset)]?.window;
  const [level, width] = store.window_.value;
  return window?.[0] === level && window[1] === width;
}

/** Whether stents are read: the cut in their window. */
export const isStentShown = computed<boolean>(
  () => chosenLook.value === STENT_LOOK && isWindowOf(STENT_PRESET),
);

/** Shows the cut through the vessels in the window for stents; the window is a step that undo takes back. */
export function chooseStent(): void {
  const look = store.started.value?.looks.find(({ name }) => name === STENT_LOOK);
  if (look) {
    chooseLook(look);
    choosePreset(presetNamed(STENT_PRESET));
  }
}

/** The name of a region's window for what is open. */
const presetOf = (region: RegionRow): string =>
  store.report.value?.windows?.is_hounsfield ? region.preset : region.preset_of_other_units;

/** The region whose look and window are shown; null where none is. */
export const chosenRegion = computed<string | null>(() => {
  const isShown = (region: RegionRow) => holds(region.settings) && isWindowOf(presetOf(region));
  return store.started.value?.regions.find(isShown)?.name ?? null;
});

/** Shows vessels and body as a region is mostly read; the window is a step that undo takes back. */
export function chooseRegion(name: string): void {
  const region = store.started.value?.regions.find((one) => one.name === name);
  if (region) {
    chooseLook(region);
    choosePreset(presetNamed(presetOf(region)));
  }
}

/** The lines that are drawn. */
export const lines = computed<Lines>(() => {
  if (!settingOf('silhouettes')) {
    return 'none';
  }
  return settingOf('silhouette_reach') === null ? 'all' : 'near';
});

/** Draws other lines; those near a vessel end where the table of settings says. */
export function chooseLines(chosen: Lines): void {
  const row = store.started.value?.table.find(({ name }) => name === 'silhouette_reach');
  store.settings.value = {
    ...store.settings.value,
    silhouettes: chosen !== 'none',
    silhouette_reach: chosen === 'all' ? null : (row?.default ?? null),
  };
}
