/** Interface of the WebAssembly modules that read volume files. */

export interface Volumes {
  readonly VolumeFile: new (name: string) => VolumeFile;
  readonly memory: WebAssembly.Memory;
}

/** A volume file that is opened and read. File names are relative to its folder; `open` and `step` return JSON. */
export interface VolumeFile {
  /** Adds the size of a file (bytes); undefined if it is missing. */
  add_size(name: string, size?: number): void;
  add_bytes(name: string, start: number, bytes: Uint8Array): void;
  open(): string;
  /** Matrix from index to world (LPS, mm): three rows of four numbers. */
  world_from_index(): Float64Array;
  /** Begins to read voxels from a file of this size (bytes), or from the unpacked gzip stream in it. */
  begin(size: number | undefined, isUnpacked: boolean): void;
  /** Replaces the bytes that the next step can read. */
  read(start: number, bytes: Uint8Array): void;
  step(): string;
  /** Address of the voxels in the memory of the module. */
  output(): number;
  free(): void;
}

/** Result of `VolumeFile.open`: the sizes or bytes that it still needs, or the plan. */
export type Opening = SizesNeeded | BytesNeeded | Plan;

interface SizesNeeded {
  readonly sizes: readonly string[];
}

interface BytesNeeded {
  readonly bytes: string;
  readonly range: Range;
}

export interface Plan {
  readonly size: readonly [number, number, number];
  /** Whether the file states lengths in mm, and the sides of the patient. */
  readonly spacing: boolean;
  readonly orientation: boolean;
  /** Name of the file that holds the voxels. */
  readonly voxels: string;
  readonly nifti: boolean;
  /** Whether the voxels are a compressed stream; `stream` is its first byte if it may be gzip, else null. */
  readonly packed: boolean;
  readonly stream: number | null;
  readonly notes: readonly string[];
  readonly label_names: Readonly<Record<string, string>>;
  /** Description in the file. It may name a patient, so only the engine reads it. */
  readonly description: string;
}

/** The first byte, and the byte after the last one. */
type Range = readonly [start: number, end: number];

/** Result of `VolumeFile.step`. */
export interface Step {
  /** Number of bytes of voxels in `VolumeFile.output`. */
  readonly filled: number;
  /** Bytes that the next step needs. */
  readonly read?: Range;
  /** Least memory that the voxels need (bytes). */
  readonly least?: number;
  readonly checked?: number;
  /** The type of the voxels, and the size of all of them (bytes). */
  readonly room?: { readonly dtype: string; readonly bytes: number };
  readonly isDone?: boolean;
}
