/** The WebAssembly module: the only file that touches it. */
import type { Judge } from './judge';
import init, { Engine, initSync, run_thread, use_threads } from './pkg/lumencut.js';

export { Engine };

/** What judges DICOM series by their headers: a module of its own, loaded when it is needed. */
export async function loadJudge(): Promise<Judge> {
  const module = await import('./pkg/dicom/lumencut_dicom.js');
  await module.default({ module_or_path: new URL('./pkg/dicom/lumencut_dicom_bg.wasm', import.meta.url) });
  return module;
}

/** What a worker needs to compute in the memory of another one. */
export interface Shared {
  readonly module: WebAssembly.Module;
  readonly memory: WebAssembly.Memory;
}

/** The memory of the module in this worker, once it is loaded. */
let held: WebAssembly.Memory | null = null;

/** How large that memory is (bytes); it never shrinks. */
export const memorySize = (): number => held?.buffer.byteLength ?? 0;

/** Loads the module into this worker. */
export async function loadModule(): Promise<Shared> {
  const address = new URL('./pkg/lumencut_bg.wasm', import.meta.url);
  const module = await WebAssembly.compileStreaming(fetch(address));
  const { memory } = await init({ module_or_path: module });
  held = memory;
  return { module, memory };
}

/** Computes in the memory of another worker, to the end of this one. */
export function joinModule({ module, memory }: Shared): void {
  initSync({ module, memory });
  run_thread();
}

/** Lets workers compute that wait in `joinModule` already. */
export function useThreads(count: number): void {
  use_threads(count);
}
