/** What the page and its worker tell each other of tracing and editing centerlines. Points are in world space (LPS, mm). */
import type { GivenFile, LineId, Pick, Progress, Report, Vector, View } from './messages';

/** A ball that no vessel may pass. */
export interface Stopper {
  readonly center: Vector;
  /** mm */
  readonly radius: number;
}

/** Vessels that are traced between clicks, at least two for each vessel, in order along it. */
export interface TraceRequest {
  readonly vessels: readonly (readonly Vector[])[];
  readonly stoppers: readonly Stopper[];
  /** Whether stretches without lumen are bridged, however long. */
  readonly bridge: boolean;
  /** Lines that are there already and do not change: a traced vessel that meets one of them ends at a point of it. */
  readonly beside: readonly LineId[];
}

/** The way that a vessel would take from a click to the pointer. */
export interface PathRequest {
  readonly from: Vector;
  readonly to: Vector;
  readonly stoppers: readonly Stopper[];
  readonly bridge: boolean;
}

/** A branch that a seed reaches; `doubt` says why it is doubtful, and is null where it is not. */
export interface SeedBranch {
  readonly line: LineId;
  readonly doubt: string | null;
}

/** Lines of a mask, one name each (empty where it has none), and what was odd about it. */
export interface MaskLines {
  readonly lines: readonly { readonly line: LineId; readonly name: string }[];
  readonly notes: readonly string[];
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
  /** The lines of vessels that were clicked, in their order. */
  trace(request: TraceRequest, told: (progress: Progress) => void): Promise<readonly LineId[]>;
  /** Refuses a place that no vessel can begin at: one outside of the scan, and one whose value alone shows that it is no lumen. */
  checkClick(click: Vector): Promise<void>;
  /** The way to the pointer, through the middles of voxels; null where none is found within 40 ms. Never throws for places without lumen. */
  path(request: PathRequest): Promise<readonly Vector[] | null>;
  /** The brightest voxel on the ray of a pixel (CSS pixels of the camera). */
  brightest(view: View, pixel: readonly [number, number]): Promise<Pick>;
  /** All branches that a seed reaches, to where they are narrower than a radius (mm); null stands for that of Python. */
  traceFrom(
    seed: Vector,
    smallestRadius: number | null,
    told: (progress: Progress) => void,
  ): Promise<readonly SeedBranch[]>;
  /** The lines of a mask of vessels, refined by the scan that is open; it must lie where the scan does. */
  traceMask(files: readonly GivenFile[], told: (progress: Progress) => void): Promise<MaskLines>;
  /** The two parts of a line that is cut at an arc length (mm); both have the point there. */
  cut(line: LineId, arcLength: number): Promise<readonly [LineId, LineId]>;
  /** One line of two, joined at the ends that are nearest to each other. */
  join(first: LineId, second: LineId): Promise<LineId>;
  /** The content of a line. */
  line(line: LineId): Promise<LineContent>;
  /** Takes over a line, as from a saved session. */
  add(content: LineContent): Promise<LineId>;
  /** Shows these lines as the vessel tree, in this order; none shows the volume alone. Windows stay as they were. */
  show(lines: readonly NamedLine[]): Promise<Report>;
  /** The bytes of a centerline file. */
  write(lines: readonly NamedLine[], kind: CenterlineKind): Promise<Uint8Array<ArrayBuffer>>;
}
