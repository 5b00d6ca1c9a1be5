/** Access to the WebAssembly module; no other file imports it. */
import init, { Engine, initSync, run_thread, use_threads } from './pkg/lumencut.js';
import type { Volumes } from './volumes';

export { Engine };

/** Loads the module for DICOM series on first use. */
export async function loadJudge(): Promise<Judge> {
  const module = await import('./pkg/dicom/lumencut_dicom.js');
  await module.default({ module_or_path: new URL('./pkg/dicom/lumencut_dicom_bg.wasm', import.meta.url) });
  return module;
}

/** Loads the module for volume files that are not compressed, or that the browser unpacks, on first use. */
export async function loadVolumes(): Promise<Volumes> {
  const { default: start, VolumeFile } = await import('./pkg/volumes/lumencut_volumes.js');
  const address = new URL('./pkg/volumes/lumencut_volumes_bg.wasm', import.meta.url);
  const { memory } = await start({ module_or_path: address });
  return { VolumeFile, memory };
}

/** Loads the module for all volume files on first use. */
export async function loadPackedVolumes(): Promise<Volumes> {
  const { default: start, VolumeFile } = await import('./pkg/packed/lumencut_packed.js');
  const address = new URL('./pkg/packed/lumencut_packed_bg.wasm', import.meta.url);
  const { memory } = await start({ module_or_path: address });
  return { VolumeFile, memory };
}

/** What a thread needs to compute in the memory of another worker. */
export interface Shared {
  readonly module: WebAssembly.Module;
  readonly memory: WebAssembly.Memory;
}

let held: WebAssembly.Memory | null = null;

/** Memory of the WebAssembly module (bytes); it never shrinks. */
export const memorySize = (): number => held?.buffer.byteLength ?? 0;

const PAGE = 65536;

/** Whether the module can have this many more bytes. It keeps them, so this is for a module that has crashed. */
export function canGrow(bytes: number): boolean {
  try {
    held?.grow(Math.ceil(bytes / PAGE));
    return true;
  } catch {
    return false;
  }
}

export async function loadModule(): Promise<Shared> {
  const address = new URL('./pkg/lumencut_bg.wasm', import.meta.url);
  const module = await WebAssembly.compileStreaming(fetch(address));
  const { memory } = await init({ module_or_path: module });
  held = memory;
  return { module, memory };
}

/** Makes this worker a compute thread in the memory of another worker; returns only when the worker ends. */
export function joinModule({ module, memory }: Shared): void {
  initSync({ module, memory });
  run_thread();
}

export function useThreads(count: number): void {
  use_threads(count);
}

/** Functions of the crate `lumencut-dicom`; arguments and results are JSON. */
export interface Judge {
  dicom_attributes(): string;
  judge_dicom(headers: string, wanted: string): string;
}
