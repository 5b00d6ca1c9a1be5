/** What the user made of a scan: vessels, stoppers and marks. It is never changed in place; `history.ts` keeps what was before. */
import type { Marks } from '../core/measuring';
import type { LineId, Pair, Vector } from '../core/messages';
import type { Stopper } from '../core/tracing';

/** A vessel that the user sees in the list. */
export interface DocumentVessel {
  /** Stays the same through edits; never given twice in a study. */
  readonly id: number;
  /** The line that the engine holds. */
  readonly line: LineId;
  readonly name: string;
  /** `#rrggbb` */
  readonly color: string;
  readonly isHidden: boolean;
  /** Where it was clicked, in order along it; null where it came from a file, a mask, a seed, or was cut or joined. */
  readonly clicks: readonly Vector[] | null;
  /** Why a branch from a seed is doubtful: it is shown apart until it is accepted. Null where it is not. */
  readonly doubt: string | null;
}

/** A straight distance between two points. */
export interface Ruler {
  readonly from: Vector;
  readonly to: Vector;
}

/** What was marked on a vessel beside the stenosis. */
export interface VesselMarks extends Marks {
  /** The ends of a stretch (mm): its length, its C-arm angles. */
  readonly stretch: Pair | null;
  /** The ends of another stretch: the angle between both. */
  readonly secondStretch: Pair | null;
}

export interface Document {
  readonly vessels: readonly DocumentVessel[];
  readonly stoppers: readonly Stopper[];
  /** Whether vessels go on where no lumen is seen. */
  readonly bridge: boolean;
  /** By the id of the vessel. */
  readonly marks: Readonly<Record<number, VesselMarks>>;
  readonly rulers: readonly Ruler[];
}

export const EMPTY: Document = { vessels: [], stoppers: [], bridge: false, marks: {}, rulers: [] };

export const NO_MARKS: VesselMarks = {
  at: null,
  references: [],
  method: 'nascet',
  original: null,
  comparison: null,
  group: null,
  stretch: null,
  secondStretch: null,
};
