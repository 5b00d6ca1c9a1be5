/** Opens files with the readers of the page, and keeps the voxels in memory. */
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { vi } from 'vitest';
import { Failure } from '../src/core/failure';
import type { States } from '../src/core/messages';
import { dicom_attributes, initSync, judge_dicom } from '../src/core/pkg/dicom/lumencut_dicom.js';
import { initSync as startEngine } from '../src/core/pkg/lumencut.js';
import { VolumeFile as PackedFile, initSync as startPacked } from '../src/core/pkg/packed/lumencut_packed.js';
import { initSync as startVolumes, VolumeFile } from '../src/core/pkg/volumes/lumencut_volumes.js';
import { ALL_OF_IT, type Wanted } from '../src/io/dicom/wanted';
import type { Kind } from '../src/io/numbers';
import { ARRAYS, byteCount } from '../src/io/numbers';
import { among, BlobSource, type Source } from '../src/io/source';
import { Steps } from '../src/io/steps';
import { openFiles } from '../src/io/study';
import { askAtOnce, kindOf } from '../src/worker/answers';

export interface Header {
  readonly size: [number, number, number];
  readonly dtype: Kind;
  readonly world_from_index: number[][];
  readonly label_names?: Record<string, string>;
}

const modules = fileURLToPath(new URL('../node_modules', import.meta.url));

export class Memory {
  header: Header | null = null;
  lines = '';
  private bytes = new Uint8Array();

  begin_volume(text: string): void {
    const header: Header = JSON.parse(text);
    this.header = header;
    this.bytes = new Uint8Array(header.size.reduce((count, side) => count * side, byteCount(header.dtype)));
  }

  take_voxels(offset: number, bytes: Uint8Array): void {
    this.bytes.set(bytes, offset);
  }

  openCenterlines(_bytes: Uint8Array, name: string): readonly string[] {
    this.lines = name;
    return [];
  }

  sideNotes(text: string): readonly string[] {
    return askAtOnce('straightened_notes', { text });
  }

  get values(): Float32Array {
    return Float32Array.from(new ARRAYS[(this.header?.dtype ?? 'uint8') as 'int16'](this.bytes.buffer));
  }
}

export interface Result {
  readonly memory: Memory;
  readonly states: States | null;
  readonly notes: readonly string[];
  readonly failure: Failure | null;
}

// The page fetches the decoders from its server; tests read them from files.
vi.stubGlobal('fetch', async (address: string) => {
  return new Response(readFileSync(address.replace(/^\/node_modules/, modules)));
});

startEngine({ module: readFileSync(new URL('../src/core/pkg/lumencut_bg.wasm', import.meta.url)) });
initSync({ module: readFileSync(new URL('../src/core/pkg/dicom/lumencut_dicom_bg.wasm', import.meta.url)) });
const { memory: ofVolumes } = startVolumes({
  module: readFileSync(new URL('../src/core/pkg/volumes/lumencut_volumes_bg.wasm', import.meta.url)),
});
const { memory: ofPacked } = startPacked({
  module: readFileSync(new URL('../src/core/pkg/packed/lumencut_packed_bg.wasm', import.meta.url)),
});

export function sourceOf(path: string, name: string): Source {
  return new BlobSource(name, new Blob([readFileSync(path)]));
}

export function below(folder: string): Source[] {
  const every = readdirSync(folder, { recursive: true }).map((name) => join(folder, String(name)));
  const files = every.filter((path) => statSync(path).isFile());
  return files.map((path) => sourceOf(path, relative(join(folder, '..'), path)));
}

/** Opens files as the page does; they may refer to the files in `others`. */
export async function openSources(
  sources: readonly Source[],
  { others = sources, wanted = {}, signal = new AbortController().signal }: Options = {},
): Promise<Result> {
  const memory = new Memory();
  const means = {
    study: memory,
    loadJudge: async () => ({ dicom_attributes, judge_dicom }),
    kindOf,
    loadVolumes: async () => ({ VolumeFile, memory: ofVolumes }),
    loadPackedVolumes: async () => ({ VolumeFile: PackedFile, memory: ofPacked }),
    steps: new Steps(() => {}, signal),
  };
  try {
    const { notes, volume } = await openFiles(sources, among(others), { ...ALL_OF_IT, ...wanted }, means);
    return { memory, notes, states: volume?.states ?? null, failure: null };
  } catch (error) {
    return { memory, notes: [], states: null, failure: Failure.of(error) };
  }
}

interface Options {
  readonly others?: readonly Source[];
  readonly wanted?: Partial<Wanted>;
  readonly signal?: AbortSignal;
}
