/** Cine: rolls the straightened vessel, or moves the section along the vessel, until the user stops it. */
import { effect, signal, untracked } from '@preact/signals';
import { moveTo } from './cross-hair';
import * as store from './store';

export type Cine = 'roll' | 'sections';

const DEGREES_PER_SECOND = 30;
const MM_PER_SECOND = 10;
/** A slow picture must not make the cine jump (s). */
const LONGEST_STEP = 0.2;

export const cine = signal<Cine | null>(null);

export function toggleCine(kind: Cine): void {
  cine.value = cine.value === kind ? null : kind;
}

export function stopCine(): void {
  cine.value = null;
}

/** Plays while a cine is on. Returns a function that stops this. */
export function followCine(): () => void {
  return effect(() => {
    const kind = cine.value;
    return kind ? everyFrame((seconds) => untracked(() => step(kind, seconds))) : undefined;
  });
}

function step(kind: Cine, seconds: number): void {
  const vessel = store.pickedVessel.value;
  const length = vessel === null ? 0 : (store.report.value?.vessels?.[vessel]?.length ?? 0);
  if (length === 0) {
    stopCine();
  } else if (kind === 'roll') {
    store.setCprAngle((store.cprAngle.value * 180) / Math.PI + DEGREES_PER_SECOND * seconds);
  } else {
    const next = store.pickedPlace.value + MM_PER_SECOND * seconds;
    // It begins again at the start of the vessel.
    moveTo(store.pickedPlace.value < length ? Math.min(next, length) : 0);
  }
}

/** Calls `work` before each frame, with the time since the last one (s). Returns a function that stops this. */
export function everyFrame(work: (seconds: number) => void): () => void {
  let frame = 0;
  let before = performance.now();
  const next = (now: number) => {
    work(Math.min((now - before) / 1000, LONGEST_STEP));
    before = now;
    frame = requestAnimationFrame(next);
  };
  frame = requestAnimationFrame(next);
  return () => cancelAnimationFrame(frame);
}
