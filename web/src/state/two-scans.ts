/** A second scan next to the open one: what is linked, pairs of places that belong together, and the comparison of a vessel. */
import { batch, computed, signal } from '@preact/signals';
import type { Failure } from '../core/failure';
import { gridOf, LINKS, type Link, type LinkedPlace, type OtherScan, type Seen } from '../core/linked';
import type {
  ComparedScans,
  LineId,
  Motion,
  SavedComparison,
  ScansToCompare,
  Vector,
  VolumeReport,
} from '../core/messages';
import { cameraBy, inverseOf, movedBy, slicesBy } from '../core/motion';
import * as store from './store';

/** Whether a second page is shown next to this one, and whether this page is the second one. */
export const isBeside = signal(false);
export const isCompanion = signal(false);

export const otherScan = signal<OtherScan | null>(null);
/** Layouts are free at first: tracing in one scan changes the layout. */
export const links = signal<readonly Link[]>(LINKS.filter((link) => link !== 'layouts'));
export const pairs = signal<readonly (readonly [Vector, Vector])[]>([]);
/** The motion to the other scan by its position or by pairs; null until the engine has answered. */
const placed = signal<Motion | null>(null);
export const isOtherEarlier = signal(true);
export const isComparing = signal(false);
export const comparisonFailure = signal<Failure | null>(null);

/** Whether both pages show the same scan: with the same grid and the same values. */
export const isSameScan = computed<boolean>(() => {
  const [here, there] = [store.report.value?.volume, otherScan.value];
  const own = [here && gridOf(here), JSON.stringify(store.histogram.value)];
  return there !== null && JSON.stringify(own) === JSON.stringify([there.grid, there.values]);
});

export interface VesselComparison {
  readonly asked: ScansToCompare;
  readonly lines: readonly [LineId, LineId];
  readonly isOtherEarlier: boolean;
  readonly answer: ComparedScans;
}

const compared = signal<VesselComparison | null>(null);

/** The comparison, as long as both vessels exist. */
export const comparison = computed<VesselComparison | null>(() => {
  const found = compared.value;
  const isHere = store.report.value?.vessels?.some(({ line }) => line === found?.lines[0]);
  const isThere = otherScan.value?.lines.includes(found?.lines[1] ?? -1);
  return isHere && isThere ? found : null;
});

/** The motion from this scan to the other one; null until it is known. */
export const motion = computed<Motion | null>(() => {
  const found = comparison.value;
  if (!found) {
    return placed.value;
  }
  return found.isOtherEarlier ? inverseOf(found.answer.motion) : found.answer.motion;
});

export function showBeside(is: boolean): void {
  batch(() => {
    isBeside.value = is;
    takeOther(null);
  });
}

export function beCompanion(): void {
  isCompanion.value = true;
}

export function takeOther(scan: OtherScan | null): void {
  batch(() => {
    const isNew = scan?.count !== otherScan.value?.count;
    otherScan.value = scan;
    if (isNew) {
      beginScans();
      takeKept();
    }
  });
}

/** Begins with a new scan on either side, which has neither pairs nor a comparison. */
export function beginScans(): void {
  batch(() => {
    forgetComparison();
    pairs.value = [];
    placed.value = null;
  });
}

export function forgetComparison(): void {
  batch(() => {
    compared.value = null;
    comparisonFailure.value = null;
  });
}

export function toggleLink(link: Link): void {
  const others = links.value.filter((one) => one !== link);
  links.value = others.length < links.value.length ? others : [...others, link];
}

export function linkAll(are: boolean): void {
  links.value = are ? LINKS : [];
}

export function addPair(here: Vector, there: Vector): void {
  pairs.value = [...pairs.value, [here, there]];
}

export function removePairs(): void {
  pairs.value = [];
}

export function setPlaced(to: Motion): void {
  placed.value = to;
}

export function setOtherEarlier(is: boolean): void {
  batch(() => {
    isOtherEarlier.value = is;
    forgetComparison();
  });
}

interface Kept {
  readonly volume: VolumeReport | null | undefined;
  readonly saved: SavedComparison;
}

let kept: Kept | null = null;

/** Takes the comparison of an opened session as soon as its other scan is open. Returns false if it waits for that scan. */
export function keepComparison(saved: SavedComparison | undefined): boolean {
  kept = saved ? { volume: store.report.value?.volume, saved } : null;
  return !saved || takeKept();
}

const keptHere = (): SavedComparison | null =>
  kept && kept.volume === store.report.value?.volume ? kept.saved : null;

function takeKept(): boolean {
  const saved = keptHere();
  if (!saved || JSON.stringify(otherScan.value?.grid) !== JSON.stringify(saved.scan)) {
    return false;
  }
  batch(() => {
    setOtherEarlier(saved.is_earlier);
    pairs.value = saved.pairs_mm;
  });
  return true;
}

export function savedComparison(): SavedComparison | null {
  const other = otherScan.value;
  return other ? { scan: other.grid, is_earlier: isOtherEarlier.value, pairs_mm: pairs.value } : keptHere();
}

export function beginComparison(): void {
  batch(() => {
    isComparing.value = true;
    comparisonFailure.value = null;
  });
}

export function endComparison(found: VesselComparison | Failure | null): void {
  batch(() => {
    isComparing.value = false;
    if (found instanceof Error) {
      compared.value = null;
      comparisonFailure.value = found;
    } else if (found) {
      compared.value = found;
    }
  });
}

/** A place has a counterpart if a section lies within this distance (mm). */
const MOST_AWAY = 1;

/** The arc length on the vessel of the other scan (mm), or of this scan for one there; null beyond the ends of the vessel. */
export function atAcross(at: number, fromOther: boolean): number | null {
  const found = comparison.value;
  const from = (found?.isOtherEarlier ?? false) === fromOther ? 0 : 1;
  const away = (place: readonly [number, number | null]) => Math.abs((place[from] ?? Infinity) - at);
  const [first, ...rest] = found?.answer.places ?? [];
  const nearest = first && rest.reduce((best, place) => (away(place) < away(best) ? place : best), first);
  return nearest && away(nearest) <= MOST_AWAY ? (nearest[1 - from] ?? null) : null;
}

const linkedParts = (seen: Seen): Seen =>
  Object.fromEntries(Object.entries(seen).filter(([name]) => links.value.includes(name as Link)));

/** What the other page shows when this page shows `seen`, or the reverse. Parts that are not linked are left out. */
export function across(seen: Seen, fromOther: boolean): Seen {
  const there = motion.value;
  if (!there) {
    return {};
  }
  const way = fromOther ? inverseOf(there) : there;
  const { cameras, 'cross-hairs': place, slices, windows, looks, layouts } = linkedParts(seen);
  const isSameUnit = otherScan.value?.isHounsfield === store.report.value?.windows?.is_hounsfield;
  return {
    ...(looks && { looks }),
    ...(layouts && { layouts }),
    ...(slices && { slices: slicesBy(way, slices) }),
    ...(windows && isSameUnit && { windows }),
    ...(cameras && { cameras: cameraBy(way, cameras) }),
    ...(place && { 'cross-hairs': placeAcross(place, movedBy(way, place.point), fromOther) }),
  };
}

function placeAcross({ line, at }: LinkedPlace, point: Vector, fromOther: boolean): LinkedPlace {
  const lines = comparison.value?.lines;
  const [from, to] = fromOther ? [lines?.[1], lines?.[0]] : [lines?.[0], lines?.[1]];
  const found = at !== null && line !== null && line === from ? atAcross(at, fromOther) : null;
  return found === null || to === undefined
    ? { point, line: null, at: null }
    : { point, line: to, at: found };
}
