/** The view in the address of the page: camera, window, settings and layout, but no data of the patient. */
import { batch, effect } from '@preact/signals';
import { areAxes, isNumber, isObject, isPositive, isVector, LARGEST } from '../core/checks';
import type { Camera, Method, SettingRow, Settings, Slices, Vector } from '../core/messages';
import { VIEW_METHODS } from '../core/method-names';
import { STANDARD } from '../core/planes';
import { slicesIn } from '../core/slices';
import { destination } from './flight';
import * as store from './store';

const WRITE_DELAY_MS = 250;
const METHODS: readonly Method[] = VIEW_METHODS.map(([name]) => name);

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
  readonly slices?: Slices;
  /** Identifies the grid of the scan, without its values. */
  readonly scan?: string;
}

export function fragmentOf(state: ViewState): string {
  return `v1=${encodeURIComponent(JSON.stringify(state))}`;
}

/** The view in a fragment, without its invalid parts; null if nothing is valid. */
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

function checked(read: Record<string, unknown>): ViewState {
  const { camera, window, method, settings, layout, inverted, vessel, place, angle, hair, scan } = read;
  const slices = slicesIn(read.slices);
  const isWindow =
    Array.isArray(window) && window.length === 2 && isNumber(window[0]) && isPositive(window[1]);
  return {
    ...(isCamera(camera) && { camera }),
    ...(isWindow && { window: window as unknown as [number, number] }),
    ...(METHODS.includes(method as Method) && { method: method as Method }),
    ...(isObject(settings) && { settings: settings as Settings }),
    ...(store.LAYOUTS.includes(layout as store.Layout) && { layout: layout as store.Layout }),
    ...(typeof inverted === 'boolean' && { inverted }),
    ...(isNumber(vessel) && { vessel }),
    ...(isNumber(place) && { place }),
    ...(isNumber(angle) && { angle }),
    ...(isVector(hair) && { hair }),
    ...(slices && { slices }),
    ...(typeof scan === 'string' && { scan }),
  };
}

function isCamera(value: unknown): value is NonNullable<ViewState['camera']> {
  if (!isObject(value)) {
    return false;
  }
  const { center, direction, up, pixel_spacing, height } = value;
  return isVector(center) && areAxes(direction, up) && isPositive(pixel_spacing) && isPositive(height);
}

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
    ...(store.slices.value !== STANDARD && { slices: store.slices.value }),
    scan: scanKey(),
  };
}

/** The FNV-1a hash of the grid of the scan, in base 36. */
function scanKey(): string {
  const volume = store.report.value?.volume;
  const grid = volume ? [volume.size, volume.world_from_index.flat().map(short)] : null;
  const bytes = new TextEncoder().encode(JSON.stringify(grid));
  return bytes.reduce((hash, byte) => Math.imul(hash ^ byte, 0x01000193) >>> 0, 0x811c9dc5).toString(36);
}

const short = (value: number): number => Math.round(value * 1000) / 1000;

/** Restores the view. Returns false, and changes nothing, if it is a view of another scan. */
export function restore(state: ViewState): boolean {
  if (state.scan !== undefined && state.scan !== scanKey()) {
    return false;
  }
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
    store.slices.value = state.slices ?? STANDARD;
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
  return true;
}

function knownSettings(settings: Settings): Settings {
  const rows = new Map(store.started.value?.table.map((row) => [row.name, row]));
  const fits = ([name, value]: [string, unknown]) => {
    const row = rows.get(name);
    return row !== undefined && isValueOf(row, value);
  };
  return Object.fromEntries(Object.entries(settings).filter(fits));
}

/** Whether a value is a length of the focus (mm) that the engine accepts. */
function isLength(value: unknown): boolean {
  return isNumber(value) && Math.abs(value) <= 1e6;
}

function isChannel(value: unknown): boolean {
  return Number.isInteger(value) && Number(value) >= 0 && Number(value) <= 255;
}

function isValueOf(row: SettingRow, value: unknown): boolean {
  if (value === null) {
    return row.optional;
  }
  const isWithin = isNumber(value) && value >= (row.low ?? -LARGEST) && value <= (row.high ?? LARGEST);
  switch (row.kind) {
    case 'flag':
      return typeof value === 'boolean';
    case 'number':
      return isWithin;
    case 'count':
      return isWithin && Number.isInteger(value);
    case 'color':
      return Array.isArray(value) && value.length === 3 && value.every(isChannel);
    case 'focus':
      return Array.isArray(value) && value.length === 2 && value.every(isLength) && Number(value[1]) >= 0;
    case 'slab':
      return (
        Array.isArray(value) && value.length === 2 && isPositive(value[0]) && typeof value[1] === 'string'
      );
    default:
      return typeof value === 'string' && row.choices.includes(value);
  }
}

/** Writes the view to the address with a delay. The attribute `data-address` tells whether the address is current. */
export function followView(): void {
  let timer = 0;
  const { dataset } = document.documentElement;
  effect(() => {
    const state = currentState();
    const isOpen = store.report.value !== null;
    window.clearTimeout(timer);
    dataset.address = isOpen ? 'pending' : 'none';
    // While the camera flies, its views are not stored.
    if (isOpen && !destination.value) {
      timer = window.setTimeout(() => {
        history.replaceState(null, '', `#${fragmentOf(state)}`);
        dataset.address = 'written';
      }, WRITE_DELAY_MS);
    }
  });
}
