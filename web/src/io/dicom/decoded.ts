/** What a decoder makes of a frame. */
import type { Bytes } from '../payload';

/** A frame that is decoded: its numbers as the decoder has them. */
export interface Decoded {
  readonly columns: number;
  readonly rows: number;
  readonly components: number;
  /** One or two bytes each, in this machine's order. */
  readonly bytes: Bytes;
  readonly unit: number;
}
