/** A decoded frame. */
import type { Bytes } from '../source';

export interface Decoded {
  readonly columns: number;
  readonly rows: number;
  readonly components: number;
  /** Samples of one or two bytes, in native byte order. */
  readonly bytes: Bytes;
  readonly unit: number;
}
