/** What computes: found at the start, and again after a GPU was lost. */
import { batch } from '@preact/signals';
import { engine } from '../client/shared';
import { Failure } from '../core/failure';
import * as store from './store';

/** A GPU that fails again within this time is given up, and the CPU continues (ms). */
const SOON = 20_000;
let lastLoss = Number.NEGATIVE_INFINITY;
let isChanging = false;
/** The device that was asked for, which is asked for again. */
let wanted = 'auto';

/** Starts the engine: on `gpu`, `any` GPU, `cpu`, or `auto`. */
export async function start(device: string): Promise<void> {
  wanted = device;
  try {
    const started = await engine.start(device);
    batch(() => {
      store.started.value = started;
      store.settings.value = store.firstSettings.value;
      store.epoch.value += 1;
    });
  } catch (error) {
    store.problem.value = Failure.of(error);
  }
}

/** Goes on after a failure of the view: with the GPU that comes back, or with the CPU. Other failures are shown. */
export function recover(error: unknown): void {
  const failure = Failure.of(error);
  if (failure.kind === 'device' && store.started.value?.isGpu) {
    const isAgain = performance.now() - lastLoss < SOON;
    lastLoss = performance.now();
    void change(isAgain ? 'cpu' : wanted, failure);
  } else if (failure.kind !== 'interrupted' && store.report.value) {
    // What was asked of a study that is closed meanwhile is not told.
    store.problem.value = failure;
  }
}

async function change(device: string, failure: Failure): Promise<void> {
  if (isChanging) {
    return;
  }
  isChanging = true;
  try {
    const changed = await engine.changeDevice(device);
    const before = store.started.value;
    const outcome = changed.isGpu ? 'it came back' : 'the CPU continues';
    batch(() => {
      store.started.value = before && { ...before, ...changed };
      store.epoch.value += 1;
      store.notes.value = [
        ...new Set([...store.notes.value, `The GPU failed (${failure.found}): ${outcome}.`]),
      ];
    });
  } catch (error) {
    store.problem.value = Failure.of(error);
  } finally {
    isChanging = false;
  }
}
