/** Replaces the state when a study is opened, closed, or shown as a session saved it; opens rejected files again. */

import { batch } from '@preact/signals';
import type {
  Camera,
  Histogram,
  Method,
  Report,
  ScanStudy,
  SeriesWish,
  Settings,
  Slices,
  States,
  Vector,
  Window,
} from '../core/messages';
import { STANDARD } from '../core/planes';
import * as store from './store';

export interface OpenedStudy {
  readonly report: Report;
  readonly name: string;
  readonly notes: readonly string[];
  readonly states: States;
  readonly study: ScanStudy | null;
  readonly histogram: Histogram | null;
  readonly camera: Camera;
  readonly hair: store.CrossHair | null;
}

/** The name of files without a common folder. */
const NO_NAME = 'files';

/** Number and description of the series, such as `2, CTA 0.75`; empty if the scan has none. */
export const seriesOf = ({ volume }: Report): string =>
  /^series (?!,)([^;]+)/.exec(volume?.scan ?? '')?.[1] ?? '';

export function takeOpened({ report, hair, ...opened }: OpenedStudy): void {
  batch(() => {
    store.report.value = report;
    store.notes.value = opened.notes;
    store.studyName.value = (opened.name === NO_NAME && seriesOf(report)) || opened.name;
    store.scanStudy.value = opened.study;
    store.states.value = opened.states;
    store.histogram.value = opened.histogram;
    store.window_.value = report.windows?.main ?? store.window_.value;
    store.camera.value = opened.camera;
    store.crossHair.value = hair;
    store.firstPlace.value = hair?.point ?? null;
    store.pickedVessel.value = hair?.vessel ?? null;
    store.pickedPlace.value = hair?.arcLength ?? 0;
    store.slices.value = STANDARD;
  });
}

export function forgetOpened(): void {
  batch(() => {
    store.report.value = null;
    store.notes.value = [];
    store.vesselDoubts.value = [];
    store.scanStudy.value = null;
    store.histogram.value = null;
    store.crossHair.value = null;
    store.pickedVessel.value = null;
    store.cprAngle.value = 0;
    store.isTurning.value = false;
    store.maximised.value = null;
    store.frameTime.value = null;
  });
}

export interface ShownView {
  readonly camera: Camera;
  readonly method: Method;
  readonly settings: Settings;
  readonly window: Window | null;
  /** The name of a layout; another name leaves the layout. */
  readonly layout: string;
  readonly crossHair: Vector | null;
  readonly slices: Slices;
}

export function showView({ camera, method, settings, window, layout, crossHair, slices }: ShownView): void {
  batch(() => {
    store.camera.value = camera;
    store.method.value = method;
    store.settings.value = settings;
    store.window_.value = window ?? store.window_.value;
    store.slices.value = slices;
    showLayoutNamed(layout);
    if (crossHair) {
      store.putCrossHair(crossHair);
    }
  });
}

export function showLayoutNamed(name: string): void {
  store.layout.value = store.LAYOUTS.find((layout) => layout === name) ?? store.layout.value;
}

type Open = (wish: SeriesWish) => Promise<void>;

let last: { readonly open: Open; readonly wish: SeriesWish } = { open: async () => {}, wish: {} };

let opening: Promise<void> = Promise.resolve();

export function openWith(wish: SeriesWish, open: Open): Promise<void> {
  last = { open, wish };
  opening = open(wish);
  return opening;
}

export async function openingEnded(): Promise<void> {
  await opening.catch(() => {});
}

export function openAgain(wish: SeriesWish): Promise<void> {
  return openWith({ ...last.wish, ...wish }, last.open);
}
