/** What the page and its worker tell each other of edits of vessels; the engine decides what they do. Points are in world space (LPS, mm). */
import type { LineId, Vector } from './messages';

/** A ball that no vessel may pass. */
export interface Stopper {
  readonly center: Vector;
  /** mm */
  readonly radius: number;
}

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

/** The part of a document that edits of vessels change. */
export interface VesselDocument {
  readonly vessels: readonly DocumentVessel[];
  readonly stoppers: readonly Stopper[];
  /** Whether vessels go on where no lumen is seen. */
  readonly bridge: boolean;
}

/** An edit of vessels, which are named by their ids. Clicks and stoppers are numbered from 0, arc lengths in mm. */
export type Edit =
  | { readonly kind: 'begin_vessel'; readonly clicks: readonly Vector[] }
  | { readonly kind: 'add_click' | 'add_click_on_line'; readonly id: number; readonly point: Vector }
  | { readonly kind: 'move_click'; readonly id: number; readonly number: number; readonly point: Vector }
  | { readonly kind: 'remove_click'; readonly id: number; readonly number: number }
  | { readonly kind: 'add_stopper'; readonly center: Vector }
  | { readonly kind: 'move_stopper'; readonly number: number; readonly center: Vector }
  | { readonly kind: 'remove_stopper'; readonly number: number }
  | { readonly kind: 'set_bridge'; readonly bridge: boolean }
  | { readonly kind: 'cut'; readonly id: number; readonly at: number }
  | { readonly kind: 'join'; readonly id: number; readonly other: number }
  | { readonly kind: 'remove' | 'accept' | 'leave_out'; readonly ids: readonly number[] }
  | { readonly kind: 'add_branches'; readonly seed: Vector }
  | { readonly kind: 'add_mask' }
  | {
      readonly kind: 'add_lines';
      readonly lines: readonly { readonly line: LineId; readonly name: string }[];
    };

export interface EditRequest {
  readonly document: VesselDocument;
  readonly edit: Edit;
  /** Whether gaps are bridged from now on, in the same step: it mends an edit that was refused by `bridge`. */
  readonly bridging: boolean;
}

/** What came of an edit. */
export interface Edited {
  readonly document: VesselDocument;
  /** The name of the step that can be undone. */
  readonly words: string;
  /** The vessels that came, by their ids. */
  readonly added: readonly number[];
  /** The vessels that lose their marks, by their ids. */
  readonly without_marks: readonly number[];
  /** What was odd, one sentence each. */
  readonly notes: readonly string[];
}
