/** What computes: found at the start, and again after a GPU was lost. */
import { batch } from '@preact/signals';
import { Failure } from '../core/failure';
import { engine } from '../core/shared';
import * as store from './store';

/** How often a GPU that is lost is looked for again; then the CPU goes on. */
const MOST_LOSSES = 5;
let losses = 0;

/** Starts the engine: on `gpu`, `any` GPU, `cpu`, or `auto`. */
export async function start(device: string): Promise<void> {
  try {
    const started = await engine.start(device);
    batch(() => {
      store.started.value = started;
      store.epoch.value += 1;
    });
  } catch (error) {
    store.problem.value = Failure.of(error);
  }
}

/** Goes on after a failure of the view: with the GPU that comes back, or with the CPU. Other failures are shown. */
export function recover(error: unknown): void {
  const failure = Failure.of(error);
  if (failure.kind === 'device' && losses < MOST_LOSSES) {
    losses += 1;
    void reopen(failure);
  } else if (failure.kind !== 'interrupted') {
    store.problem.value = failure;
  }
}

async function reopen(failure: Failure): Promise<void> {
  try {
    const device = await engine.reopenDevice();
    const before = store.started.value;
    batch(() => {
      store.started.value = before && { ...before, ...device };
      store.epoch.value += 1;
      store.notes.value = [...store.notes.value, `The GPU failed (${failure.found}); ${device.isGpu ? 'it came back' : 'the CPU goes on'}.`];
    });
  } catch (error) {
    store.problem.value = Failure.of(error);
  }
}
