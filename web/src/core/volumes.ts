/** Interface of the Rust code that reads volume files. */

/** The module of the crate `lumencut-volumes-wasm`. */
export interface Volumes {
  readonly VolumeFile: new (name: string) => VolumeFile;
  readonly memory: WebAssembly.Memory;
}

/** A volume file that is being opened and read. Names are relative to its folder; answers are JSON. */
export interface VolumeFile {
  /** Adds the size of a file (bytes), undefined for a missing one. */
  add_size(name: string, size?: number): void;
  add_bytes(name: string, start: number, bytes: Uint8Array): void;
  open(): string;
  /** Three rows of four numbers, LPS (mm). */
  world_from_index(): Float64Array;
  /** Begins to fill the volume from a file of this size. */
  begin(size?: number): void;
  /** Replaces the bytes that the next step can read. */
  read(start: number, bytes: Uint8Array): void;
  step(): string;
  /** Address of voxels in the memory of the module. */
  output(): number;
  free(): void;
}

/** Answer of `VolumeFile.open`: what it still needs of files, or the plan. */
export type Opening = SizesNeeded | BytesNeeded | Plan;

interface SizesNeeded {
  /** Names of files. */
  readonly sizes: readonly string[];
}

interface BytesNeeded {
  /** Name of a file. */
  readonly bytes: string;
  readonly range: Range;
}

export interface Plan {
  readonly size: readonly [number, number, number];
  /** Whether the file states lengths in mm, and the sides of the patient. */
  readonly spacing: boolean;
  readonly orientation: boolean;
  /** Name of the file of the voxels. */
  readonly voxels: string;
  readonly notes: readonly string[];
  readonly label_names: Readonly<Record<string, string>>;
  /** Description in the file. It may name a patient, so only the engine reads it. */
  readonly description: string;
}

/** First byte, and the byte behind the last one. */
type Range = readonly [start: number, end: number];

/** Answer of `VolumeFile.step`. */
export interface Step {
  /** Bytes of voxels in `VolumeFile.output`. */
  readonly filled: number;
  /** Bytes that the next step needs. */
  readonly read?: Range;
  /** Bytes of memory that the voxels need at least. */
  readonly least?: number;
  readonly checked?: number;
  /** The type of the voxels, and bytes of all of them. */
  readonly room?: { readonly dtype: string; readonly bytes: number };
  readonly isDone?: boolean;
}
