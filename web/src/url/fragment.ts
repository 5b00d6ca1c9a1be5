/**
 * The view in the address: camera, window, settings, layout. It holds nothing of the patient: no name of a file, no value of
 * a voxel. What cannot be read is left out.
 */
import { batch, effect } from '@preact/signals';
import type { Camera, Method, Settings, Vector } from '../core/messages';
import * as store from '../state/store';

/** How long nothing changes before the address does (ms). */
const QUIET = 250;
const METHODS: readonly Method[] = ['csr', 'csr-paper', 'mpcpr', 'cr'];

/** What the address says of a view. */
export interface ViewState {
  readonly camera?: Omit<Camera, 'size'> & { readonly height: number };
  readonly window?: readonly [number, number];
  readonly method?: Method;
  readonly settings?: Settings;
  readonly layout?: store.Layout;
  readonly inverted?: boolean;
  readonly vessel?: number;
  readonly place?: number;
  readonly angle?: number;
  readonly hair?: Vector;
}

/** The state as the part of an address behind `#`. */
export function fragmentOf(state: ViewState): string {
  return `v1=${encodeURIComponent(JSON.stringify(state))}`;
}

/** The state that a fragment tells; none where it tells nothing that can be read. */
export function stateOf(fragment: string): ViewState | null {
  const text = new URLSearchParams(fragment.replace(/^#/, '')).get('v1');
  if (text === null) {
    return null;
  }
  try {
    const read: unknown = JSON.parse(text);
    return read !== null && typeof read === 'object' ? checked(read as Record<string, unknown>) : null;
  } catch {
    return null;
  }
}

const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value);
const isVector = (value: unknown): value is Vector =>
  Array.isArray(value) && value.length === 3 && value.every(isNumber);

function checked(read: Record<string, unknown>): ViewState {
  const { camera, window, method, settings, layout, inverted, vessel, place, angle, hair } = read;
  const isWindow =
    Array.isArray(window) && window.length === 2 && window.every(isNumber) && Number(window[1]) > 0;
  return {
    ...(isCamera(camera) && { camera }),
    ...(isWindow && { window: window as unknown as [number, number] }),
    ...(METHODS.includes(method as Method) && { method: method as Method }),
    ...(settings !== null && typeof settings === 'object' && { settings: settings as Settings }),
    ...(store.LAYOUTS.includes(layout as store.Layout) && { layout: layout as store.Layout }),
    ...(typeof inverted === 'boolean' && { inverted }),
    ...(isNumber(vessel) && { vessel }),
    ...(isNumber(place) && { place }),
    ...(isNumber(angle) && { angle }),
    ...(isVector(hair) && { hair }),
  };
}

function isCamera(value: unknown): value is NonNullable<ViewState['camera']> {
  const camera = value as NonNullable<ViewState['camera']> | null;
  const isWhole =
    camera !== null && typeof camera === 'object' && isVector(camera.center) && isVector(camera.direction);
  return isWhole && isVector(camera.up) && camera.pixel_spacing > 0 && camera.height > 0;
}

/** The view as it is now. */
export function currentState(): ViewState {
  const camera = store.camera.value;
  const hair = store.crossHair.value;
  const vessel = store.pickedVessel.value;
  return {
    ...(camera && {
      camera: {
        center: camera.center.map(short) as unknown as Vector,
        direction: camera.direction,
        up: camera.up,
        pixel_spacing: camera.pixel_spacing,
        height: Math.min(...camera.size),
      },
    }),
    window: store.window_.value,
    method: store.method.value,
    settings: store.settings.value,
    layout: store.layout.value,
    inverted: store.isInverted.value,
    ...(vessel !== null && { vessel }),
    place: short(store.pickedPlace.value),
    angle: store.cprAngle.value,
    ...(hair && { hair: hair.point.map(short) as unknown as Vector }),
  };
}

const short = (value: number): number => Math.round(value * 1000) / 1000;

/** Shows what an address tells, over what is shown. */
export function restore(state: ViewState): void {
  batch(() => {
    const size = store.camera.value?.size ?? ([512, 512] as const);
    if (state.camera) {
      const { height, ...camera } = state.camera;
      store.camera.value = {
        ...camera,
        size,
        pixel_spacing: (camera.pixel_spacing * height) / Math.min(...size),
      };
    }
    store.window_.value = state.window ?? store.window_.value;
    store.method.value = state.method ?? store.method.value;
    store.settings.value = knownSettings(state.settings ?? store.settings.value);
    store.layout.value = state.layout ?? store.layout.value;
    store.isInverted.value = state.inverted ?? store.isInverted.value;
    store.cprAngle.value = state.angle ?? store.cprAngle.value;
    const count = store.report.value?.vessels?.length ?? 0;
    if (
      state.vessel !== undefined &&
      Number.isInteger(state.vessel) &&
      state.vessel >= 0 &&
      state.vessel < count
    ) {
      store.pickedVessel.value = state.vessel;
      store.pickedPlace.value = state.place ?? 0;
    }
    if (state.hair) {
      store.crossHair.value = { point: state.hair, value: null, vessel: null, arcLength: null };
    }
  });
}

/** The settings that the table knows. */
function knownSettings(settings: Settings): Settings {
  const names = new Set(store.started.value?.table.map((row) => row.name));
  return Object.fromEntries(Object.entries(settings).filter(([name]) => names.has(name)));
}

/** Writes the view into the address from now on, some time after it changed. */
export function followView(): void {
  let timer = 0;
  effect(() => {
    const state = currentState();
    const isOpen = store.report.value !== null;
    window.clearTimeout(timer);
    if (isOpen) {
      timer = window.setTimeout(() => history.replaceState(null, '', `#${fragmentOf(state)}`), QUIET);
    }
  });
}
