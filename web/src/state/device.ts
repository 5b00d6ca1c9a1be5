/** Selects the compute device at the start of the page, and again if the GPU is lost. */
import { batch } from '@preact/signals';
import { Failure } from '../core/failure';
import { engine } from '../worker/engine';
import * as store from './store';

/** If the GPU fails twice within this time (ms), the CPU replaces it. */
const GIVE_UP_WITHIN_MS = 20_000;
let lastLoss = Number.NEGATIVE_INFINITY;
let isChanging = false;
/** The device that the user requested; also used after a loss. */
let wanted = 'auto';

/** Starts the engine on a device: `gpu`, `any` (also a software GPU), `cpu` or `auto`. */
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

/** Recovers from a lost GPU; shows any other failure. */
export function recover(error: unknown): void {
  const failure = Failure.of(error);
  if (failure.kind === 'device' && store.started.value?.isGpu) {
    const isAgain = performance.now() - lastLoss < GIVE_UP_WITHIN_MS;
    lastLoss = performance.now();
    void change(isAgain ? 'cpu' : wanted, failure);
  } else if (failure.kind !== 'interrupted' && store.report.value) {
    // If the study was closed meanwhile, its errors do not matter.
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
    const outcome = changed.isGpu ? 'it recovered' : 'the CPU continues';
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
