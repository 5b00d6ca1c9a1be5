/** Which reformation stands in the pane of the picked vessel, and what is chosen of it. */
import { signal } from '@preact/signals';
import type { MapOf, Reformation, Side } from '../core/messages';

/** The straightened CPR, or another reformation in its place. */
export type ReformationKind = 'cpr' | Reformation['kind'];

/** How readers call them, in the order to show them. */
export const REFORMATIONS: readonly (readonly [ReformationKind, string])[] = [
  ['cpr', 'Straightened CPR'],
  ['uncurl', 'Uncurled CPR'],
  ['spiral', 'Spiral CPR'],
  ['map', 'Lumen map'],
  ['untangled', 'Untangled CPR'],
];

export const reformationKind = signal<ReformationKind>('cpr');
/** How far a vessel is straightened, from 0 to 1. */
export const uncurled = signal(0.5);
/** What a lumen map shows. */
export const mapOf = signal<MapOf>('wall');

/** What a reformation is made from. */
export interface Chosen {
  readonly vessel: number | null;
  /** From where the turning view is seen; null before it is shown. */
  readonly side: Side | null;
  /** The rotation about the vessel (radians). */
  readonly angle: number;
  readonly amount: number;
  readonly of: MapOf;
}

/** The message that asks for a reformation; null while there is nothing that it could be made from. */
export function reformationOf(kind: Reformation['kind'], chosen: Chosen): Reformation | null {
  const { vessel, side, angle, amount, of } = chosen;
  if (vessel === null) {
    return null;
  }
  switch (kind) {
    case 'untangled':
      return side && { kind, side };
    case 'uncurl':
      return side && { kind, vessel, side, amount };
    case 'spiral':
      return { kind, vessel, angle };
    default:
      return { kind, vessel, of };
  }
}

/** How the pane of the picked vessel is called. */
export const reformationTitle = (): string =>
  REFORMATIONS.find(([kind]) => kind === reformationKind.value)?.[1] ?? '';
