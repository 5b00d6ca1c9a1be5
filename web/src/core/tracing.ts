/** What the page and its worker tell each other of tracing and editing centerlines. Points are in world space (LPS, mm). */
import type { Edited, EditRequest, Stopper, VesselDocument } from './edits';
import type { GivenFile, LineId, Pick, Progress, Report, Vector, View } from './messages';

/** The way that a vessel would take from a click to the pointer. */
export interface PathRequest {
  readonly from: Vector;
  readonly to: Vector;
  readonly stoppers: readonly Stopper[];
  readonly bridge: boolean;
}

/** All numbers of a line. */
export interface LineContent {
  readonly points: readonly Vector[];
  /** mm; null where it is not known, of all points or of one */
  readonly radius: readonly (number | null)[] | null;
  /** From 0 to 1. */
  readonly confidence: readonly number[] | null;
  /** Which points lie on a stretch without lumen that was bridged. */
  readonly bridged: readonly boolean[] | null;
}

/** A line as it is shown and saved. */
export interface NamedLine {
  readonly line: LineId;
  readonly name: string;
}

export type CenterlineKind = 'vtp' | 'mrk.json';

/** Tracing and editing. All of it throws `Failure`; one of kind `tracing` has the weakest place as `place`, and the `value` there. */
export interface Tracing {
  /** The document that the study begins with: the vessels that were opened, counted from 1. */
  beginDocument(): Promise<VesselDocument>;
  /** What comes of an edit of vessels; one that adds a mask comes with the files of the mask. */
  edit(
    request: EditRequest,
    told: (progress: Progress) => void,
    mask: readonly GivenFile[] | null,
  ): Promise<Edited>;
  /** Refuses a place that no vessel can begin at: one outside of the scan, and one whose value alone shows that it is no lumen. */
  checkClick(click: Vector): Promise<void>;
  /** The way to the pointer, through the middles of voxels; null where none is found within 40 ms. Never throws for places without lumen. */
  path(request: PathRequest): Promise<readonly Vector[] | null>;
  /** The brightest voxel on the ray of a pixel (CSS pixels of the camera). */
  brightest(view: View, pixel: readonly [number, number]): Promise<Pick>;
  /** The content of a line. */
  line(line: LineId): Promise<LineContent>;
  /** Takes over a line, as from a saved session. */
  add(content: LineContent): Promise<LineId>;
  /** Shows these lines as the vessel tree, in this order; none shows the volume alone. Windows stay as they were. */
  show(lines: readonly NamedLine[]): Promise<Report>;
  /** The bytes of a centerline file. */
  write(lines: readonly NamedLine[], kind: CenterlineKind): Promise<Uint8Array<ArrayBuffer>>;
}
