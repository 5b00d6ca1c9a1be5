/** Panels beside the views: the list of vessels, the tour, the dividers between panes, and maximised views. */
import { type Signal, signal } from '@preact/signals';
import { type Layout, maximised, type ViewName } from './store';

export const isListOpen = signal(false);

/** Below this window width the list would cover the views (CSS pixels). */
const NARROW = 760;

export function openList(): void {
  isListOpen.value ||= window.innerWidth > NARROW;
}

export function toggleList(): void {
  isListOpen.value = !isListOpen.value;
}

/** Current step of the tour, counted from 0; null without a tour. */
export const guideStep = signal<number | null>(null);

export function goToGuideStep(step: number | null): void {
  guideStep.value = step;
}

/** Positions of the vertical dividers, as shares of the width of the layout. */
export const columns: Readonly<Record<Layout, Signal<number>>> = {
  one: signal(1),
  two: signal(0.67),
  four: signal(0.5),
  strip: signal(0.75),
  measure: signal(0.42),
  report: signal(0.5),
};
export const rows: Readonly<Partial<Record<Layout, Signal<number>>>> = {
  four: signal(0.5),
  measure: signal(0.5),
};

const MIN_SHARE = 0.12;

export function moveDivider(place: Signal<number>, to: number): void {
  place.value = Math.min(Math.max(to, MIN_SHARE), 1 - MIN_SHARE);
}

export function toggleMaximised(name: ViewName): void {
  maximised.value = maximised.value === name ? null : name;
}

export function showAllViews(): void {
  maximised.value = null;
}
