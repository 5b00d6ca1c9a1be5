/** Interface of the Rust code that reads volume files. */
import type { VolumeFile } from './pkg/volumes/lumencut_volumes';

/** The module of the crate `lumencut-volumes`. */
export interface Volumes {
  readonly VolumeFile: typeof VolumeFile;
  readonly memory: WebAssembly.Memory;
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
