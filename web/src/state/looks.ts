/** The looks: several settings under one name, as the table of the core says what each of them chooses. */
import { batch, computed } from '@preact/signals';
import type { LookRow, SettingValue } from '../core/messages';
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
  // Without vessels no focus counts, and the context is all there is.
  const counts = (name: string) => store.hasTree.value || name === 'context';
  const isChosen = (look: LookRow) =>
    isOffered(look) &&
    Object.entries(look.settings).every(([name, own]) => !counts(name) || agrees(name, settingOf(name), own));
  return looks.find(isChosen)?.name ?? null;
});

/** Shows vessels and body by a look. */
export function chooseLook(look: LookRow): void {
  batch(() => {
    store.method.value = 'csr';
    store.settings.value = { ...store.settings.value, ...look.settings };
  });
}

/** The look whose cut stents are read in. */
export const STENT_LOOK = 'lumen';
const stentPreset = computed(
  () => store.report.value?.windows?.presets.findIndex(({ name }) => name === 'stent') ?? -1,
);

/** Whether stents are read: the cut in their window. */
export const isStentShown = computed<boolean>(() => {
  const window = store.report.value?.windows?.presets[stentPreset.value]?.window;
  const [level, width] = store.window_.value;
  return chosenLook.value === STENT_LOOK && window?.[0] === level && window[1] === width;
});

/** Shows the cut through the vessels in the window for stents; the window is a step that undo takes back. */
export function chooseStent(): void {
  const look = store.started.value?.looks.find(({ name }) => name === STENT_LOOK);
  if (look) {
    chooseLook(look);
    choosePreset(stentPreset.value);
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
