/** Actions of the user. They only change the store; the views react to it. */

import { batch } from '@preact/signals';
import { panned, resized, spun, trackballed, turnedAbout, zoomed } from '../core/camera';
import { GESTURES } from '../core/generated/tables';
import type { Camera, Pair, SettingValue, Vector, Window } from '../core/messages';
import { STANDARD } from '../core/planes';
import type { Action } from '../input/bindings';
import { engine } from '../worker/engine';
import { stopCine } from './cine';
import { destination, flyToAnswer } from './flight';
import { viewChanged, windowChanged } from './history';
import { dropLength, isArriving } from './measuring';
import { dragPlaceTurn, endPlaceTurn, placeTurn, togglePlaceTurn } from './place-turn';
import { stopMeasuring } from './profiles';
import { putRulerAway } from './rulers';
import { showLines, toggleLines } from './slices';
import * as store from './store';
import { tool } from './tool';

export function changeCamera(change: (camera: Camera) => Camera): void {
  const camera = store.camera.value;
  if (camera) {
    store.camera.value = change(camera);
  }
}

function pivot(camera: Camera): Vector {
  return store.crossHair.value?.point ?? camera.center;
}

export function dragTurning(action: Action, by: Pair, axis: Vector | null): void {
  if (placeTurn.value && (action === 'rotate' || action === 'rotate about vessel')) {
    dragPlaceTurn(by[0], store.camera.value?.size[1] ?? 1);
    return;
  }
  switch (action) {
    case 'rotate':
      changeCamera((camera) => trackballed(camera, pivot(camera), by));
      break;
    case 'rotate about vessel': {
      const about = axis ?? store.camera.value?.up ?? [0, 0, 1];
      changeCamera((camera) => spun(camera, pivot(camera), about, by[0]));
      break;
    }
    case 'pan':
      changeCamera((camera) => panned(camera, by));
      break;
    case 'window':
      dragWindow(by);
      break;
    default:
  }
}

/** The point under the pointer stays fixed. */
export function zoomTurning(factor: number, at: Pair): void {
  changeCamera((camera) => zoomed(camera, factor, at));
}

/** The view before a drag, which Escape restores. */
let before = kept();

function kept() {
  const [camera, to] = [store.camera.value, destination.value];
  // A drag ends a flight of the camera. If the drag is cancelled, the view jumps to the destination of the flight.
  return {
    camera: camera && to ? resized(to, camera.size) : camera,
    window: store.window_.value,
    turn: placeTurn.value,
  };
}

export function windowBack(): { begin(): void; end(): void; putBack(): void } {
  return {
    begin: () => {
      before = kept();
    },
    end: () => windowChanged(before.window),
    putBack: () =>
      batch(() => {
        store.camera.value = before.camera;
        store.window_.value = before.window;
        placeTurn.value = before.turn;
      }),
  };
}

/** A drag to the right widens the window; a drag upwards makes the picture brighter. */
export function dragWindow([x, y]: Pair): void {
  const [level, width] = store.window_.value;
  const { window_per_pixel: part, narrowest_window: narrowest } = GESTURES;
  store.window_.value = [level + y * part * width, Math.max(width * Math.exp(x * part), narrowest)];
}

/** Changes the window during a drag. Afterwards `windowChanged` records one undo step. */
export function setWindow(window: Window): void {
  store.window_.value = [window[0], Math.max(window[1], GESTURES.narrowest_window)];
}

/** Sets the window as one undo step. */
export function chooseWindow(window: Window | undefined): void {
  if (window) {
    const before = store.window_.value;
    setWindow(window);
    windowChanged(before);
  }
}

export const choosePreset = (number: number): void =>
  chooseWindow(store.report.value?.windows?.presets[number]?.window);

export function settingOf(name: string): SettingValue {
  const chosen = store.ownSettings.value[name];
  const row = store.started.value?.table.find((setting) => setting.name === name);
  return chosen === undefined ? (row?.default ?? null) : chosen;
}

export function setSetting(name: string, value: SettingValue): void {
  store.settings.value = { ...store.settings.value, [name]: value };
}

export async function showNamedView(name: string): Promise<void> {
  const camera = store.camera.value;
  if (camera && store.report.value) {
    await flyToAnswer(engine.ask('fitted', { view: name, size: camera.size }));
  }
}

export async function showBestView(): Promise<void> {
  const [camera, line] = [store.camera.value, store.pickedLine()];
  if (camera && line !== null) {
    await flyToAnswer(engine.ask('best_view', { camera, line }));
  }
}

type ModeLayout = 'measure' | 'report';
const isOfMode = (layout: store.Layout): layout is ModeLayout => layout === 'measure' || layout === 'report';

/** The layout before measuring or the report was opened. */
let layoutBefore: store.Layout = 'strip';

export function toggleLayout(wanted: ModeLayout): void {
  if (tool.value !== 'ruler' || wanted === 'report') {
    // Ends the tracing tool, since clicks must not set points here. This also restores the layout before tracing.
    tool.value = 'look';
  }
  const now = store.layout.value;
  layoutBefore = isOfMode(now) ? layoutBefore : now;
  showLayout(now === wanted ? layoutBefore : wanted);
}

export function showLayout(layout: store.Layout): void {
  batch(() => {
    store.maximised.value = null;
    store.layout.value = layout;
    isArriving.value = layout === 'measure';
  });
}

/** Half of a window that is narrower than this has room for one view (CSS pixels). */
const NARROW = 600;

export function showOneIfNarrow(width: number): void {
  if (width < NARROW) {
    showLayout('one');
  }
}

export function turnSlowly(angle: number): void {
  changeCamera((camera) => turnedAbout(camera, pivot(camera), [0, 0, 1], angle));
}

export function perform(action: Action): void {
  if (action.startsWith('view ')) {
    void showNamedView(action.slice('view '.length));
  } else if (action.startsWith('preset ')) {
    choosePreset(Number(action.slice('preset '.length)));
  } else {
    performSimple(action);
  }
}

function performSimple(action: Action): void {
  switch (action) {
    case 'invert':
      store.isInverted.value = !store.isInverted.value;
      break;
    case 'context':
      setSetting('context', settingOf('context') === null ? 'mida' : null);
      break;
    case 'silhouettes':
      setSetting('silhouettes', !settingOf('silhouettes'));
      break;
    case 'measure':
    case 'report':
      toggleLayout(action);
      break;
    case 'best view':
      void showBestView();
      break;
    case 'turn about place':
      void togglePlaceTurn();
      break;
    case 'turn planes':
      toggleLines();
      break;
    case 'turn':
      store.isTurning.value = !store.isTurning.value;
      break;
    case 'help':
      store.isHelpOpen.value = !store.isHelpOpen.value;
      break;
    case 'cancel':
      cancel();
      break;
    case 'reset':
      reset();
      break;
    default:
  }
}

function cancel(): void {
  putRulerAway();
  dropLength();
  if (store.progress.value) {
    void engine.cancel();
    store.progress.value = null;
  }
  stopMeasuring();
  stopCine();
  endPlaceTurn();
  showLines(false);
  batch(() => {
    store.isHelpOpen.value = false;
    store.isTurning.value = false;
    store.maximised.value = null;
    store.problem.value = null;
  });
}

function reset(): void {
  const windows = store.report.value?.windows;
  const before = { window: store.window_.value, slices: store.slices.value };
  batch(() => {
    store.isInverted.value = false;
    store.isTurning.value = false;
    store.cprAngle.value = 0;
    store.cprRoll.value = null;
    store.resets.value += 1;
    store.slices.value = STANDARD;
    store.window_.value = windows?.main ?? before.window;
    viewChanged('reset the views', before);
  });
  void showNamedView('anterior');
}
