/** The view as pages with two scans exchange it. Only the page that the user operates sends its view. */
import { batch, computed, effect } from '@preact/signals';
import { resized } from '../core/camera';
import { gridOf, type LinkedPlace, type OtherScan, type Seen } from '../core/linked';
import type { VolumeReport } from '../core/messages';
import { settled } from '../core/slices';
import { setWindow } from './actions';
import { moveCrossHair, moveTo } from './cross-hair';
import { showLayoutNamed, showView } from './opened';
import * as store from './store';

type Part = () => Seen | null;

const PARTS: readonly Part[] = [
  () => store.camera.value && { cameras: store.camera.value },
  () => ({ slices: store.slices.value }),
  () => ({ windows: store.window_.value }),
  () => ({ layouts: store.layout.value }),
  () => ({
    looks: {
      method: store.method.value,
      settings: store.settings.value,
      isInverted: store.isInverted.value,
    },
  }),
  () => placeNow(),
];

function placeNow(): Seen | null {
  const hair = store.crossHair.value;
  const line = store.report.value?.vessels?.[hair?.vessel ?? -1]?.line ?? null;
  return hair && { 'cross-hairs': { point: hair.point, line, at: hair.arcLength } };
}

export const viewSize = computed(() => store.camera.value?.size.join('x') ?? '');

/** Whether the user operates this page, and not the other one. */
let isOperated = true;

export function setOperated(is: boolean): void {
  isOperated = is;
}

export const seenNow = (): Seen => Object.assign({}, ...PARTS.map((part) => part()));

/** Tells each change of the view while the user operates this page. Returns a function that stops this. */
export function followSeen(send: (seen: Seen) => void): () => void {
  const ends = PARTS.map((part) =>
    effect(() => {
      const seen = part();
      if (seen && isOperated) {
        send(seen);
      }
    }),
  );
  return () => {
    for (const end of ends) {
      end();
    }
  };
}

/** Shows what the user sees in the other page. Panes keep their sizes, and pixels their size in mm. */
export function takeSeen({ cameras, slices, windows, layouts, looks, 'cross-hairs': place }: Seen): void {
  setOperated(false);
  const camera = store.camera.value;
  batch(() => {
    if (cameras && camera) {
      const { pixel_spacing } = cameras;
      store.camera.value = { ...resized(cameras, camera.size), pixel_spacing };
    }
    if (slices) {
      store.slices.value = settled(slices);
    }
    if (windows) {
      setWindow(windows);
    }
    if (layouts) {
      showLayoutNamed(layouts);
    }
    if (looks && store.camera.value) {
      const { isInverted, ...look } = looks;
      store.isInverted.value = isInverted;
      const free = { window: null, layout: '', crossHair: null, slices: store.slices.value };
      showView({ ...look, ...free, camera: store.camera.value });
    }
  });
  if (place) {
    takePlace(place);
  }
}

function takePlace({ point, line, at }: LinkedPlace): void {
  const vessel = store.report.value?.vessels?.findIndex((one) => one.line === line) ?? -1;
  if (vessel >= 0 && at !== null) {
    store.pickVessel(vessel, at);
    moveTo(at);
  } else {
    moveCrossHair(point, 'turning');
  }
}

let counted: VolumeReport | null = null;
let count = 0;

/** The open scan as the other page knows it; null if none is open. */
export function scanNow(): OtherScan | null {
  const report = store.report.value;
  if (report?.volume && report.volume !== counted) {
    counted = report.volume;
    count += 1;
  }
  return report?.volume
    ? {
        count,
        name: store.studyName.value,
        grid: gridOf(report.volume),
        values: JSON.stringify(store.histogram.value),
        corners: report.volume.corners,
        lines: (report.vessels ?? []).map(({ line }) => line),
        isHounsfield: report.windows?.is_hounsfield ?? false,
        size: viewSize.value,
      }
    : null;
}
