/** What the page and its worker tell each other of measuring. Lengths are in mm along a vessel, or in mm; points in world space (LPS, mm). */
import type { LineId, Method, Pair, Progress, Settings, Vector } from './messages';

export type StenosisMethod = 'nascet' | 'ecst' | 'area';
export type Territory = 'carotid' | 'coronary';

/** A place on a vessel and the diameter there (mm). */
export interface Spot {
  readonly at: number;
  readonly diameter: number;
}

/** A flag of sections as readers meet it. */
export interface FlagLook {
  readonly word: string;
  readonly meaning: string;
  /** Its colour on the dark ground of the page. */
  readonly screen: string;
}

/** The lumen of a vessel by its arc length: one entry for each section, null where nothing was measured. */
export interface Profile {
  readonly arc_length: readonly number[];
  /** Of a circle of the same area (mm). */
  readonly diameter: readonly (number | null)[];
  readonly diameter_min: readonly (number | null)[];
  readonly diameter_max: readonly (number | null)[];
  /** mm² */
  readonly area: readonly (number | null)[];
  /** The standard deviation of `diameter` (mm). */
  readonly uncertainty: readonly (number | null)[];
  /** Whether a section counts for what is narrowest, widest or suggested. */
  readonly counts: readonly boolean[];
  /** Words such as `calcium`, `no edge`. */
  readonly flags: readonly (readonly string[])[];
  /** Every flag that there is, in the order of plots and tables. */
  readonly flag_table: readonly FlagLook[];
  readonly center: readonly Vector[];
  /** Full width at half maximum of the point spread (mm), and how it was found: `given`, `estimated on …`, `assumed: …`. */
  readonly fwhm: number;
  readonly fwhm_source: string;
  /** Suggestions, not findings. */
  readonly narrowest: Spot | null;
  /** The longest diameter; null also where an odd outline or a branch may be what makes it so. */
  readonly widest: Spot | null;
}

/** What a reader marked on one vessel (arc lengths, mm). */
export interface Marks {
  /** The place of a stenosis. */
  readonly at: number | null;
  /** One or two places to compare it with. */
  readonly references: readonly number[];
  readonly method: StenosisMethod;
  /** The assumed original diameter (mm), for ECST. */
  readonly original: number | null;
  /** The diameter of a vessel like the normal one (mm). */
  readonly comparison: number | null;
  readonly group: Territory | null;
}

/** Places that are compared before anything is graded (arc lengths, mm). */
export interface Compared {
  readonly at: number;
  readonly references: readonly number[];
  readonly method: StenosisMethod;
}

/** What is told of a place that was marked: one of both, or nothing where none is marked. */
export interface Grade {
  readonly stenosis: Stenosis | null;
  /** What is still missing, or what is wrong with a place. */
  readonly not_graded: string | null;
}

export interface Stenosis {
  readonly percent: number;
  readonly at: number;
  readonly diameter: number;
  readonly uncertainty: number | null;
  readonly reference: number;
  readonly references: readonly Spot[];
  readonly method: StenosisMethod;
  /** The percentage in one line. Python's `str(stenosis)` has it with its doubts. */
  readonly words: string;
  /** What makes the percentage doubtful, a sentence each. */
  readonly doubts: readonly string[];
  /** The group of the field with its source, where a territory was named. */
  readonly group: string | null;
}

/** A marked stretch of a vessel. */
export interface Stretch {
  readonly length: number;
  readonly straight: number;
  /** `length` in straight distances; null where it ends where it begins. */
  readonly tortuosity: number | null;
  /** Unit vector along it. */
  readonly direction: Vector;
  /** How a C-arm is turned that shows it in its whole length (radians), and as it stands on a C-arm: `RAO 20° CRAN 5°`. */
  readonly lao: number;
  readonly cranial: number;
  readonly c_arm: string;
  /** From the viewer into the scene, and upwards, of the view from the detector of that C-arm. */
  readonly view: { readonly direction: Vector; readonly up: Vector };
}

/** The section of a profile that is nearest to an arc length. */
export interface MeasuredSection {
  /** Its number in the profile. */
  readonly number: number;
  /** The points of the wall; empty where none was found. */
  readonly contour: readonly Vector[];
  /** The ends of the shortest and of the longest diameter. */
  readonly shortest: readonly [Vector, Vector] | null;
  readonly longest: readonly [Vector, Vector] | null;
}

/** A vessel for tables: its id and name, its line, and what was marked on it. */
export interface MeasuredVessel {
  readonly id: string;
  readonly name: string;
  readonly line: LineId;
  readonly marks: Marks;
}

/** A place of a report. */
export interface ReportPlace {
  /** Such as `marked place`, or `reference before (suggestion)`. */
  readonly name: string;
  readonly at: number;
  readonly is_suggestion: boolean;
  readonly is_reference: boolean;
}

/** The pictures that the report of a vessel asks for (mm). */
export interface ReportPlan {
  /** Of the straightened vessel: what is seen across it, and the side of a pixel. */
  readonly width: number;
  readonly spacing: number;
  /** The places whose sections are shown, in this order, and the side of their pictures. */
  readonly places: readonly ReportPlace[];
  readonly side: number;
}

/** What the report of a vessel is made of; pictures are PNGs in base64. */
export interface ReportRequest {
  readonly vessel: MeasuredVessel;
  /** The name of the scan, where the user wants it there. */
  readonly scan: string | null;
  /** When it was saved, in words. */
  readonly saved: string;
  readonly has_units: boolean;
  readonly has_orientation: boolean;
  /** Level and width. */
  readonly window: Pair;
  readonly settings: Settings;
  readonly view: { readonly picture: string; readonly method: Method };
  /** The straightened vessel from left to right, its columns and rows, and the side of a pixel (mm). */
  readonly strip: { readonly picture: string; readonly size: Pair; readonly spacing: number };
  /** A section for each place of the plan. */
  readonly sections: readonly string[];
  /** Stretches from one arc length to another, and straight distances (mm). */
  readonly stretches: readonly Pair[];
  readonly distances: readonly number[];
}

/** Measuring. All of it throws `Failure`. Profiles are kept by line as long as the study is open. */
export interface Measuring {
  /** The profile of a line among the lines that are shown: kept, or measured with a step of 0.5 mm. */
  profile(line: LineId, fwhm: number | null, told: (progress: Progress) => void): Promise<Profile>;
  /** The stenosis that was marked, or why it is not graded. */
  grade(line: LineId, marks: Marks): Promise<Grade>;
  /** What would make a percentage from these places doubtful, a sentence each. */
  doubts(line: LineId, compared: Compared): Promise<readonly string[]>;
  /** The references that are offered before and after the stenosis, on sides where none is marked. */
  offeredReferences(line: LineId, marks: Marks): Promise<readonly [Spot | null, Spot | null]>;
  /** The diameter at a place and its standard deviation. */
  diameterAt(
    line: LineId,
    at: number,
  ): Promise<{ readonly diameter: number; readonly uncertainty: number | null }>;
  section(line: LineId, at: number): Promise<MeasuredSection>;
  stretch(line: LineId, ends: Pair): Promise<Stretch>;
  /** The angle between two stretches (radians): 0 where the second goes on as the first does. */
  angleBetween(line: LineId, first: Pair, second: Pair): Promise<number>;
  /** The table that `lumencut measure -o x.csv` writes. */
  csv(vessels: readonly MeasuredVessel[]): Promise<string>;
  /** What `lumencut measure -o x.json` writes. */
  json(vessels: readonly MeasuredVessel[]): Promise<string>;
  /** The pictures that the report of a vessel asks for. */
  reportPlan(vessel: MeasuredVessel): Promise<ReportPlan>;
  /** The report as HTML, as `lumencut measure --report` writes it. */
  report(request: ReportRequest): Promise<string>;
}
