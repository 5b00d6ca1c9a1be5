/** Turns the planes of the slices, and makes them thick. Each change is one undo step. */
import { batch, signal } from '@preact/signals';
import type { Slices } from '../core/messages';
import { type SliceName, STANDARD } from '../core/planes';
import { SLAB_MODES, settled, turnedSlices } from '../core/slices';
import { slicesChanged } from './history';
import { hasMillimetres } from './millimetres';
import { layout, maximised, slices, TURN_STEP } from './store';

export const areLinesShown = signal(false);

export function showLines(areShown: boolean): void {
  areLinesShown.value = areShown;
}

export function toggleLines(): void {
  batch(() => {
    areLinesShown.value = !areLinesShown.value;
    if (areLinesShown.value && maximised.value === null) {
      layout.value = 'four';
    }
  });
}

let begun: Slices | null = null;

export function beginTurn(): void {
  begun = slices.value;
}

/** Turns the planes other than `about` by an angle (radians) since the turn began. */
export function turnPlanes(about: SliceName, angle: number): void {
  if (begun) {
    slices.value = turnedSlices(begun, about, angle);
  }
}

export function endTurn(): void {
  if (begun) {
    slicesChanged('turn the planes', begun);
    begun = null;
  }
}

export function putTurnBack(): void {
  slices.value = begun ?? slices.value;
  begun = null;
}

export function turnBySteps(about: SliceName, steps: number): void {
  beginTurn();
  turnPlanes(about, steps * TURN_STEP);
  endTurn();
}

export function straighten(): void {
  const before = slices.value;
  slices.value = settled({ ...STANDARD, slab: before.slab });
  slicesChanged('reset the planes', before);
}

export function chooseSlab(slab: Slices['slab']): void {
  const before = slices.value;
  slices.value = settled({ ...before, slab });
  slicesChanged('change the slab', before);
}

/** What distinguishes a slice from a standard one, such as `oblique, MIP 10 mm`; empty if nothing. */
export function sliceWords(name: SliceName): string {
  const { slab, ...planes } = slices.value;
  const mode = slab && SLAB_MODES.find(([mode]) => mode === slab[1])?.[1];
  const words = [
    planes[name] === STANDARD[name] ? '' : 'oblique',
    slab ? `${mode} ${slab[0]}${hasMillimetres.value ? ' mm' : ''}` : '',
  ];
  return words.filter(Boolean).join(', ');
}
