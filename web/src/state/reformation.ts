/** The selected reformation of the picked vessel, and its options. */
import { signal } from '@preact/signals';
import type { LensOf, MapOf, Reformation, Side } from '../core/messages';

export type ReformationKind = 'cpr' | Reformation['kind'];

export const REFORMATIONS: readonly (readonly [ReformationKind, string])[] = [
  ['cpr', 'Straightened CPR'],
  ['uncurl', 'Uncurled CPR'],
  ['spiral', 'Spiral CPR'],
  ['map', 'Lumen map'],
  ['endoscopy', 'Endoscopy'],
  ['untangled', 'Untangled CPR'],
  ['network', 'Network map'],
];

export const reformationKind = signal<ReformationKind>('cpr');
/** Degree of straightening of the uncurled CPR, from 0 to 1. */
export const uncurled = signal(0.5);
export const mapOf = signal<MapOf>('wall');

export const lensOf = signal<LensOf>('perspective');
/** Whether the eye looks towards the start of the vessel. */
export const looksBack = signal(false);

export function chooseReformation(kind: ReformationKind): void {
  reformationKind.value = kind;
}

export function setUncurled(degree: number): void {
  uncurled.value = Math.min(Math.max(degree, 0), 1);
}

export function chooseMap(of: MapOf): void {
  mapOf.value = of;
}

export function chooseLens(of: LensOf): void {
  lensOf.value = of;
}

export function lookBack(isBack: boolean): void {
  looksBack.value = isBack;
}

export interface Chosen {
  readonly vessel: number | null;
  /** Direction of the turning view; null before that view is shown. */
  readonly side: Side | null;
  /** Rotation of the reformation about the vessel (radians). */
  readonly angle: number;
  readonly amount: number;
  readonly of: MapOf;
  /** Place of the section, where the eye of an endoscopy is (mm). */
  readonly at: number;
  readonly lens: LensOf;
  readonly backwards: boolean;
}

/** Request for a reformation; null if it cannot be made yet. */
export function reformationOf(kind: Reformation['kind'], chosen: Chosen): Reformation | null {
  const { vessel, side, angle, amount, of, at, lens, backwards } = chosen;
  if (vessel === null) {
    return null;
  }
  switch (kind) {
    case 'untangled':
    case 'network':
      return side && { kind, side };
    case 'uncurl':
      return side && { kind, vessel, side, amount };
    case 'spiral':
      return { kind, vessel, angle };
    case 'endoscopy':
      return { kind, vessel, at, lens, backwards };
    default:
      return { kind, vessel, of };
  }
}

export const reformationTitle = (): string =>
  REFORMATIONS.find(([kind]) => kind === reformationKind.value)?.[1] ?? '';
