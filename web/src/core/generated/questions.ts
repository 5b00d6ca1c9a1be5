/** What the engine is asked and answers, written of `crates/lumencut/src/study/questions.rs` by `make generate`; a test says where it is stale. */
import type { Bytes, Pair, Settings, SettingValue, Turn, Vector } from '../plain';

export type Method = 'csr' | 'csr-paper' | 'cr' | 'mpcpr';
export type StenosisMethod = 'nascet' | 'ecst' | 'area';
export type Territory = 'carotid' | 'coronary';

export type AfterEdit = {
  readonly edited: Edited;
  /** The state after the edit, in which all vessels that are not doubtful are shown. */
  readonly report: Report;
  /** The lines that the document before the edit did not have. */
  readonly lines: ReadonlyArray<NumberedLine>;
  /** Facts about the lines that are not doubtful. */
  readonly facts: ReadonlyArray<LineFacts>;
  /** What lies at the place of the edit, if the edit has a place. */
  readonly pick: Pick | null;
};

/** A linear axis: `low` (mm) lies at pixel `start`, `high` at `end`. */
export type Axis = {
  /** Length at the start (mm). */
  readonly low: number;
  /** Length at the end (mm). */
  readonly high: number;
  /** First plot pixel. */
  readonly start: number;
  /** Last plot pixel. */
  readonly end: number;
};

/** An orthographic camera, with unit vectors as axes. */
export type Camera = {
  readonly center: Vector;
  readonly direction: Vector;
  readonly up: Vector;
  readonly size: Pair;
  /** Pixel side (mm). */
  readonly pixel_spacing: number;
};

export type CenterlineWish = {
  /** `lps` or `ras`. */
  readonly coordinates?: string;
  /** `um`, `mm`, `cm`, `dm` or `m`. */
  readonly unit?: string;
  readonly reorder?: boolean;
};

/** A chart in plot pixels from its upper left corner. Curves are SVG paths. */
export type ChartLayout = {
  readonly size: Pair;
  readonly y: Axis;
  /** Height of a row of flags; the first row begins below diameter 0. */
  readonly row: number;
  /** Distance between the words of flags; the last word aligns with the last row. */
  readonly word_row: number;
  /** The end of the last row. */
  readonly bottom: number;
  /** Ticks along x and y. */
  readonly ticks: readonly [ReadonlyArray<Tick>, ReadonlyArray<Tick>];
  /** The band from the shortest to the longest diameter. */
  readonly range: string;
  /** The band of the uncertainty. */
  readonly spread: string;
  /** Diameters of the circle of the same area. */
  readonly width: string;
  /** Diameters of sections without neighbours. */
  readonly isolated: ReadonlyArray<Pair>;
  /** Diameters of omitted sections. */
  readonly left_out: ReadonlyArray<Pair>;
  /** The limit of resolution. */
  readonly limit: Tick | null;
  readonly flags: ReadonlyArray<FlagBars>;
};

/** A stenosis and the places to compare it with before it is graded, such as offered references (arc lengths, mm). */
export type Compared = {
  readonly at: number;
  readonly references: ReadonlyArray<number>;
  readonly method: StenosisMethod;
};

/** The lumen of a vessel in two scans, compared. */
export type ComparedScans = {
  /** Doubts, changes, the typical difference, and how the vessels were matched. */
  readonly sentences: ReadonlyArray<string>;
  /** Arc lengths on the earlier and on the later vessel (mm) that belong together; null beyond its ends. */
  readonly places: ReadonlyArray<readonly [number, number | null]>;
  /** The motion from the earlier scan to the later one. */
  readonly motion: Motion;
  /** Diameters and differences as SVG, and their axis of arc lengths on the earlier vessel (plot pixels). */
  readonly chart: string;
  readonly axis: Axis;
};

/** A control point of a transfer function: intensity (unit of the volume), colour (RGB) and opacity per mm. */
export type ControlPoint = readonly [number, Vector, number];

export type Cpr = {
  readonly vessel: number;
  /** Rotation about the axis of the vessel (radians). */
  readonly angle: number;
  /** Width of the picture (mm). */
  readonly width: number;
  /** Pixel side (mm). */
  readonly pixel_spacing: number;
  /** The CFA feature of a half circle; none to show the values of the scan. */
  readonly feature: Feature | null;
  /** The side of the lumen that rows follow; none for a constant angle. */
  readonly roll: Roll | null;
};

export type Diameter = {
  /** Diameter of the circle of the same area (mm). */
  readonly diameter: number;
  /** Standard deviation of the diameter (mm). */
  readonly uncertainty: number | null;
};

export type DocumentVessel = {
  /** Identifies the vessel: it is constant through edits and unique in a study. */
  readonly id: number;
  readonly line: number;
  /** Name; may be empty. */
  readonly name: string;
  /** `#rrggbb`. */
  readonly color: string;
  readonly isHidden: boolean;
  /** The clicks of the vessel in order; none if it came from a file, mask or seed, or was cut or joined. */
  readonly clicks: ReadonlyArray<Vector> | null;
  /** Why a found branch is doubtful, until it is accepted. */
  readonly doubt: string | null;
  /** The contours that were drawn by hand on the vessel's line. */
  readonly contours: ReadonlyArray<ReadonlyArray<number>>;
};

export type DoubtRow = {
  /** The reason as a phrase, for documents and session files. */
  readonly words: string;
  readonly short: string;
};

export type DoubtfulPlace = {
  /** A sentence that states the reason of the doubt. */
  readonly words: string;
  /** The arc length (mm) from which, or up to which, the vessel is doubtful, to show and cut there; none for the whole line. */
  readonly at: number | null;
};

/** A contour while it is drawn, with its numbers. */
export type DrawnContour = {
  /** Arc length of the section; centre; radii (mm). */
  readonly contour: ReadonlyArray<number>;
  readonly points: ReadonlyArray<Vector>;
  /** Diameter of the circle of the same area (mm). */
  readonly diameter: number;
  readonly shortest: number;
  readonly longest: number;
  /** Area (mm²). */
  readonly area: number;
};

/** The letters at the four edges of a picture. */
export type EdgeLetters = {
  /** At the left edge. */
  readonly left: string;
  /** At the right edge. */
  readonly right: string;
  /** At the top edge. */
  readonly top: string;
  /** At the bottom edge. */
  readonly bottom: string;
};

/** An edit of vessels. Clicks and stoppers are numbered from 0; arc lengths in mm. */
export type Edit = {
  readonly "kind": "begin_vessel";
  readonly clicks: ReadonlyArray<Vector>;
} | {
  readonly "kind": "add_click";
  readonly id: number;
  readonly point: Vector;
} | {
  readonly "kind": "add_click_on_line";
  readonly id: number;
  readonly point: Vector;
} | {
  readonly "kind": "move_click";
  readonly id: number;
  readonly number: number;
  readonly point: Vector;
} | {
  readonly "kind": "remove_click";
  readonly id: number;
  readonly number: number;
} | {
  readonly "kind": "add_stopper";
  readonly center: Vector;
} | {
  readonly "kind": "move_stopper";
  readonly number: number;
  readonly center: Vector;
} | {
  readonly "kind": "remove_stopper";
  readonly number: number;
} | {
  readonly "kind": "set_bridge";
  readonly bridge: boolean;
} | {
  readonly "kind": "set_dark";
  readonly dark: boolean;
} | {
  readonly "kind": "hide_bone";
  readonly hidden: boolean;
} | {
  readonly "kind": "cut";
  readonly id: number;
  readonly at: number;
} | {
  readonly "kind": "bend";
  readonly id: number;
  readonly at: number;
  readonly to: Vector;
} | {
  readonly "kind": "smooth";
  readonly id: number;
  readonly sigma: number;
} | {
  readonly "kind": "join";
  readonly id: number;
  readonly other: number;
} | {
  readonly "kind": "remove";
  readonly ids: ReadonlyArray<number>;
} | {
  readonly "kind": "add_branches";
  readonly seed: Vector;
} | {
  readonly "kind": "add_whole_vessel";
  readonly click: Vector;
} | {
  readonly "kind": "find_vessels";
  /** Whether to return only doubtful vessels if none is confident; otherwise that is an error. */
  readonly doubtful: boolean;
} | {
  readonly "kind": "accept";
  readonly ids: ReadonlyArray<number>;
} | {
  readonly "kind": "leave_out";
  readonly ids: ReadonlyArray<number>;
} | {
  readonly "kind": "add_mask"
} | {
  readonly "kind": "add_lines";
  readonly lines: ReadonlyArray<NamedLine>;
};

export type EditRequest = {
  readonly document: VesselDocument;
  readonly edit: Edit;
  /** Whether to bridge gaps from now on, in the same step. This is the remedy for an edit that was rejected with `bridge`. */
  readonly bridging: boolean;
};

export type Edited = {
  /** The document after the edit; unchanged if there was nothing to do. */
  readonly document: VesselDocument;
  /** The name of the undo step. */
  readonly words: string;
  readonly added: ReadonlyArray<number>;
  readonly without_marks: ReadonlyArray<number>;
  readonly notes: ReadonlyArray<string>;
  /** Places from which found vessels are doubtful. */
  readonly doubts: ReadonlyArray<VesselDoubt>;
  /** The report on the traced vessel, if it is a single one. */
  readonly told: Told | null;
};

export type Feature = "max" | "mean" | "min";

export type Finding = {
  readonly line: number;
  readonly sentences: ReadonlyArray<Sentence>;
};

export type Findings = {
  readonly vessels: ReadonlyArray<Finding>;
  readonly distances: ReadonlyArray<string>;
};

export type FirstClick = {
  readonly pick: Pick;
  /** The whole vessel that the click would add. */
  readonly whole: WholeVessel | null;
};

export type FlagBars = {
  readonly look: FlagLook;
  /** First and last column of each bar. */
  readonly bars: ReadonlyArray<Pair>;
};

/** A flag of a section. */
export type FlagLook = {
  /** The word for the flag in tables and reports, such as `no clear wall`; it is part of the file formats. */
  readonly word: string;
  /** What the flag means, as part of a sentence. */
  readonly meaning: string;
  /** The colour of the flag on a dark screen, `#rrggbb`. */
  readonly screen: string;
};

export type Grade = {
  readonly stenosis: Stenosis | null;
  /** The diameter, if a place is marked, and why there is no percentage. */
  readonly not_graded: string | null;
  /** A place that is narrower than the marked one, in one sentence. */
  readonly narrower: string | null;
};

export type Histogram = {
  readonly low: number;
  readonly high: number;
  /** Number of values in each range, from the lowest range on; the largest value counts in the last range. */
  readonly counts: ReadonlyArray<number>;
};

/** The kind of a file in the words of messages. */
export type KnownFile = {
  /** The identifier of the kind. */
  readonly kind: string;
  /** What it can be opened as. */
  readonly role: Role;
  /** What it is called, such as `a NIfTI volume`. */
  readonly words: string;
  /** How to make it readable; empty if it is read. */
  readonly mend: string;
};

/** How a picture lies in space: unit vectors right and down (LPS), width in pixels, pixel side (mm). */
export type LaidPicture = {
  readonly right: Vector;
  readonly down: Vector;
  readonly width: number;
  readonly pixel_spacing: number;
};

/** What colours mean: words, unit, the values of the first and the last colour, and colours at equal steps. */
export type Legend = {
  readonly words: string;
  readonly unit: string;
  readonly low: number;
  readonly high: number;
  readonly colours: ReadonlyArray<Vector>;
};

export type LensOf = "perspective" | "fisheye";

export type LineContent = {
  /** At least two points (mm, LPS). */
  readonly points: ReadonlyArray<Vector>;
  /** Radius (mm); null if unknown, for all points or for one. */
  readonly radius: ReadonlyArray<number | null> | null;
  /** The confidence of each point (0 to 1) of a traced line. */
  readonly confidence: ReadonlyArray<number> | null;
  /** Whether each point lies on a bridged stretch without lumen, if known. */
  readonly bridged: ReadonlyArray<boolean> | null;
  /** Whether the reader moved each point by hand; null if none was moved. */
  readonly by_hand: ReadonlyArray<boolean> | null;
};

export type LineFacts = {
  readonly line: number;
  readonly length: number;
  /** Median diameter (mm); null if no radius is known. */
  readonly calibre: number | null;
  /** Index of the connected part that contains the line; 0 is the longest part. */
  readonly part: number;
  /** The line from which this line branches; null for the widest line of a part. */
  readonly parent: number | null;
  /** The name that the rules suggest; null if they are not sure. */
  readonly suggested_name: string | null;
  /** Whether the line seems to be a vein or part of the heart. */
  readonly is_vein_or_heart: boolean;
};

/** A line in a viewer's list. A hidden line is not drawn but is measured together with the others, so hiding changes no number. */
export type ListedLine = {
  readonly line: number;
  /** Name; may be empty. */
  readonly name: string;
  readonly hidden: boolean;
  /** Contours that were drawn by hand on the line. */
  readonly contours: ReadonlyArray<ReadonlyArray<number>>;
};

export type Look = {
  readonly direction: Vector;
  readonly up: Vector;
};

export type LookRow = {
  /** Name in Python and on the command line. */
  readonly name: string;
  readonly words: string;
  readonly sentence: string;
  /** The values of all settings that any look sets; the default if this look does not set one. */
  readonly settings: Settings;
};

export type MapOf = "wall" | "radius" | "thickness";

export type Mark = {
  readonly words: string;
  readonly pixel: Pair;
};

/** A reader's marks on one vessel (arc lengths, mm). */
export type Marks = {
  readonly at: number | null;
  readonly references: ReadonlyArray<number>;
  readonly method: StenosisMethod;
  /** The assumed original diameter of the vessel (mm), for ECST. */
  readonly original: number | null;
  /** The diameter of a comparable normal vessel (mm). */
  readonly comparison: number | null;
  readonly group: Territory | null;
  /** The ends of a stretch, for length and C-arm angles. */
  readonly stretch: Pair | null;
  /** The ends of a second stretch, for the angle between both stretches. */
  readonly secondStretch: Pair | null;
  readonly diameters: ReadonlyArray<number>;
  /** Arc lengths of marks that confirm suggestions. */
  readonly confirmed: ReadonlyArray<number>;
};

export type MeasureLayout = {
  /** The axis of the arc length, common to vessel and chart. */
  readonly x: Axis;
  readonly strip: StripLayout;
  readonly chart: ChartLayout | null;
};

export type MeasurePane = {
  readonly line: number;
  /** Whether the line was measured; otherwise it gets no chart. */
  readonly is_measured: boolean;
  /** Width and height of the pane (plot pixels). */
  readonly size: Pair;
  /** Height between vessel and chart that the viewer uses for other elements (plot pixels). */
  readonly between: number;
  /** Number of pixels of the straightened vessel per plot pixel. */
  readonly density: number;
};

/** A section: its number, the wall, and the ends of the shortest and longest diameter (mm, LPS). */
export type MeasuredSection = {
  readonly number: number;
  /** The contour of the wall; empty if none was found. */
  readonly contour: ReadonlyArray<Vector>;
  /** The outer wall around thrombus or plaque; empty if it is not seen. */
  readonly outer_contour: ReadonlyArray<Vector>;
  /** The lumen of the line and the other one behind a flap; empty if they are not seen. */
  readonly own_lumen: ReadonlyArray<Vector>;
  readonly other_lumen: ReadonlyArray<Vector>;
  readonly shortest: readonly [Vector, Vector] | null;
  readonly longest: readonly [Vector, Vector] | null;
};

export type MeasuredVessel = {
  readonly id: string;
  /** Name; may be empty. */
  readonly name: string;
  readonly line: number;
  readonly marks: Marks;
};

/** A rigid motion (mm, LPS): a point times `rotation`, plus `shift`. */
export type Motion = {
  /** The rows of the matrix. */
  readonly rotation: readonly [Vector, Vector, Vector];
  readonly shift: Vector;
};

export type NamedLine = {
  readonly line: number;
  /** Name; may be empty. */
  readonly name: string;
};

export type NamedWindow = {
  readonly name: string;
  readonly words: string;
  readonly window: Pair;
};

/** A stretch of a vessel where nothing was measured. */
export type NotMeasured = {
  readonly from_mm: number;
  readonly to_mm: number;
  /** Where to cut the vessel to remove the unmeasured stretch (arc length, mm). */
  readonly cut_mm: number;
  /** A sentence that states the reason. */
  readonly words: string;
};

export type NumberedLine = {
  readonly line: number;
  readonly content: LineContent;
};

export type OpenedLines = {
  readonly notes: ReadonlyArray<string>;
  /** Evidence against the space or unit in which the file was read. */
  readonly doubt: PlaceDoubt | null;
};

export type PathRequest = {
  readonly from: Vector;
  readonly to: Vector;
  readonly stoppers: ReadonlyArray<Stopper>;
  /** Whether to bridge stretches without lumen, however long. */
  readonly bridge: boolean;
};

export type Pick = {
  readonly point: Vector;
  /** The volume's value; none outside. */
  readonly value: number | null;
  /** The vessel in whose lumen, or next to whose lumen, the point lies; none in tissue. */
  readonly vessel: number | null;
  /** The arc length on the vessel nearest to the point (mm). */
  readonly arc_length: number | null;
};

/** RGBA in rows from the top. */
export type Picture = {
  /** Columns and rows. */
  readonly size: Pair;
  /** One byte per channel. */
  readonly bytes: Bytes;
};

export type PictureLabels = {
  readonly letters: EdgeLetters;
  readonly bar: ScaleBar | null;
};

export type PlaceDoubt = {
  /** The finding, in words. */
  readonly found: string;
  /** Other spaces and units that fit, such as `lps in cm`; may be empty. */
  readonly readings: ReadonlyArray<string>;
};

/** The views about a place on a vessel, which runs upwards through the middle of the picture. */
export type PlaceTurn = {
  /** The first view: the one nearest to the anterior view. */
  readonly camera: Camera;
  /** The cut diameter (mm) after each degree from 0 to 179; then the diameters repeat. None if two walls are not found. */
  readonly diameters: ReadonlyArray<number | null>;
};

/** A flat picture: centre in world space, unit vectors right and down (LPS), size in pixels, pixel side (mm). */
export type Plane = {
  readonly center: Vector;
  readonly right: Vector;
  readonly down: Vector;
  readonly size: Pair;
  readonly pixel_spacing: number;
  /** Thickness (mm) and mode of a slab centred on the plane; without one, the picture shows the plane itself. */
  readonly slab?: readonly [number, string] | null;
};

export type PointedAt = {
  /** The pointed place (LPS, mm). */
  readonly point: Vector;
  /** Unit vector of the ray, away from the viewer; none if only the place counts. */
  readonly along: Vector | null;
};

export type PointedLumen = {
  /** The pointed place in the lumen; on a ray, the place nearest to the lumen's centre. */
  readonly point: Vector;
  readonly center: Vector;
  /** Diameter of the lumen (mm). */
  readonly diameter: number;
  /** The median value at the centre of the lumen. */
  readonly value: number;
  /** Unit vector to the right in the section. */
  readonly right: Vector;
  readonly down: Vector;
};

/** The lumen of a vessel by arc length, in mm and mm²; NaN (null in JSON) if not measured. */
export type Profile = {
  readonly arc_length: ReadonlyArray<number>;
  /** Diameter of the circle of the same area (mm). */
  readonly diameter: ReadonlyArray<number | null>;
  readonly diameter_min: ReadonlyArray<number | null>;
  readonly diameter_max: ReadonlyArray<number | null>;
  readonly area: ReadonlyArray<number | null>;
  /** The standard deviation of `diameter` (mm). */
  readonly uncertainty: ReadonlyArray<number | null>;
  /** Whether each section is considered for the narrowest, widest and suggested places. */
  readonly counts: ReadonlyArray<boolean>;
  /** Words for the flags of each section, such as `calcium`, `no clear wall`. */
  readonly flags: ReadonlyArray<ReadonlyArray<string>>;
  /** The two bounds of each diameter next to calcium or metal, or its limit at a dim throat, in words. */
  readonly bounds: ReadonlyArray<string | null>;
  /** All flags, in the order of plots and tables. */
  readonly flag_table: ReadonlyArray<FlagLook>;
  readonly center: ReadonlyArray<Vector>;
  /** FWHM of the point spread (mm). */
  readonly fwhm: number;
  /** The source of the point-spread width: `given`, `estimated on …`, `assumed: …`. */
  readonly fwhm_source: string;
  /** The expected level of the wall, or why walls were not separated. */
  readonly wall_source: string;
  readonly narrowest: Spot | null;
  /** A narrower place that is not suggested, for the reason in `not_suggested`. */
  readonly passed_over: Spot | null;
  /** The place of a throat that must be narrower than all measured places (arc length, mm), else null. */
  readonly throat: number | null;
  /** The largest diameter; none if an unusual outline or a branch may be its cause. */
  readonly widest: Spot | null;
  /** Why no narrowest place or reference is suggested, one sentence each. */
  readonly not_suggested: ReadonlyArray<string>;
  readonly not_measured: ReadonlyArray<NotMeasured>;
  /** The outer wall around thrombus or plaque, in one sentence. */
  readonly outer_stretch: string | null;
  /** Diameter of each outer wall around thrombus or plaque, in words. */
  readonly outer: ReadonlyArray<string | null>;
  /** The longest stretch with a flap, in one sentence. */
  readonly flap_stretch: string | null;
  /** Areas of the line's lumen, of the other one behind a flap, and of both, in words. */
  readonly lumens: ReadonlyArray<readonly [string, string, string] | null>;
};

export type Reformation = {
  readonly "kind": "untangled";
  readonly side: Side;
} | {
  readonly "kind": "network";
  readonly side: Side;
} | {
  readonly "kind": "uncurl";
  readonly vessel: number;
  readonly side: Side;
  /** How far the vessel is straightened, from 0 (as seen) to 1 (straight). */
  readonly amount: number;
} | {
  readonly "kind": "spiral";
  readonly vessel: number;
  /** The rotation of sections (radians). */
  readonly angle: number;
} | {
  readonly "kind": "map";
  readonly vessel: number;
  readonly of: MapOf;
} | {
  readonly "kind": "endoscopy";
  readonly vessel: number;
  /** Arc length (mm). */
  readonly at: number;
  readonly lens: LensOf;
  /** Whether the eye looks towards the start of the vessel. */
  readonly backwards: boolean;
};

export type ReformedPicture = {
  /** Columns and rows. */
  readonly size: Pair;
  /** One byte per channel. */
  readonly bytes: Bytes;
  /** What rows, columns and colours mean. */
  readonly words: string;
  /** Pixel side (mm). */
  readonly pixel_spacing: number;
  readonly marks: ReadonlyArray<Mark>;
};

export type RegionRow = {
  readonly name: string;
  readonly words: string;
  readonly sentence: string;
  /** Values of all settings that any look sets. */
  readonly settings: Settings;
  /** Window name for Hounsfield units. */
  readonly preset: string;
  /** Window name for other units. */
  readonly preset_of_other_units: string;
};

export type Report = {
  /** None if only vessels are open. */
  readonly volume: VolumeReport | null;
  /** The shown vessels; None if only the volume is open. */
  readonly vessels: ReadonlyArray<VesselReport> | null;
  /** Suggested windows; none if no volume is open. */
  readonly windows: Windows | null;
  /** Whether the centerlines opened last seem to be in the wrong order and can be sorted; omitted if not. */
  readonly can_reorder?: boolean;
};

/** A place in a report, with its name and colour. */
export type ReportPlace = {
  /** The name, such as `marked place` or `reference before (suggestion)`. */
  readonly name: string;
  /** Arc length (mm). */
  readonly at: number;
  /** Whether the place is suggested, and was not marked by a reader. */
  readonly is_suggestion: boolean;
  readonly is_reference: boolean;
};

/** The pictures of a vessel. */
export type ReportPlan = {
  /** The width of the straightened vessel (mm); the picture is narrower if the volume is. */
  readonly width: number;
  /** Pixel side of the straightened vessel (mm). */
  readonly spacing: number;
  /** The places of the section pictures, in order. */
  readonly places: ReadonlyArray<ReportPlace>;
  /** Pixel side of the section pictures (mm). */
  readonly section_spacing: number;
};

export type ReportRequest = {
  readonly vessels: ReadonlyArray<ReportVessel>;
  readonly scan: string | null;
  readonly saved: string;
  readonly stated: Stated;
  /** Whether the reader assumed the voxel spacing. */
  readonly is_millimetre_assumed: boolean;
  readonly window: Pair;
  /** View settings that differ from the defaults. */
  readonly settings: Settings;
  /** Straight distances (mm), shown on the first page. */
  readonly distances: ReadonlyArray<number>;
};

/** The straightened vessel from left to right. The vessel starts in the middle of the first column. */
export type ReportStrip = {
  /** PNG in base64. */
  readonly picture: string;
  /** Columns and rows. */
  readonly size: Pair;
  /** Pixel side (mm). */
  readonly spacing: number;
};

/** A vessel with its report pictures (PNG, base64). */
export type ReportVessel = {
  readonly vessel: MeasuredVessel;
  readonly view: ReportView;
  readonly strip: ReportStrip;
  readonly sections: ReadonlyArray<string>;
};

/** A view of all vessels. */
export type ReportView = {
  /** PNG in base64. */
  readonly picture: string;
  /** The method of the view, such as `csr`. */
  readonly method: Method;
};

/** What a file can be opened as. */
export type Role = "volume" | "centerlines" | "other";

export type Roll = "narrowest" | "widest";

/** A doubtful branch that was found from a seed. */
export type SavedBranch = {
  /** Colour as `#rrggbb`. */
  readonly color: string;
  /** Reason for the doubt. */
  readonly doubt: string;
};

/** An orthographic camera; its axes are unit vectors. */
export type SavedCamera = {
  /** Centre of the image. */
  readonly center: Vector;
  /** Direction from the viewer into the scene. */
  readonly direction: Vector;
  /** Direction that is up in the image. */
  readonly up: Vector;
  /** Number of columns and rows. */
  readonly size: Pair;
  /** Side of a pixel (mm). */
  readonly pixel_spacing: number;
};

/** A scan that the reader compares with the scan of the session. */
export type SavedComparison = {
  /** Its grid, by which it is recognised. */
  readonly scan: SavedScan;
  /** Whether it is the earlier one. */
  readonly is_earlier: boolean;
  /** Places in the session's scan and in this one that belong together (mm, LPS). */
  readonly pairs_mm: ReadonlyArray<readonly [Vector, Vector]>;
};

/** Marks that the reader set on a vessel; arc lengths and diameters are in mm. */
export type SavedMarks = {
  /** Arc length of a stenosis. */
  readonly at_mm: number | null;
  /** Arc lengths of the references. */
  readonly references_mm: ReadonlyArray<number>;
  /** Grading method: `nascet`, `ecst` or `area`. */
  readonly method: string;
  /** Assumed original diameter at the stenosis, for ECST. */
  readonly original_mm: number | null;
  /** Diameter of a comparable normal vessel, for NASCET. */
  readonly comparison_mm: number | null;
  /** Territory for grades: `carotid` or `coronary`. */
  readonly group: string | null;
  /** Arc lengths of the ends of a segment. */
  readonly stretch_mm: Pair | null;
  /** Arc lengths of the ends of a second segment. */
  readonly second_stretch_mm: Pair | null;
  /** Arc lengths of noted diameters; exist since version 2. */
  readonly diameters_mm?: ReadonlyArray<number>;
  /** Arc lengths of marks that confirm suggestions; exist since version 2. */
  readonly confirmed_mm?: ReadonlyArray<number>;
};

/** A place on a vessel. */
export type SavedPlace = {
  /** Number of the vessel, from 0. */
  readonly vessel: number;
  /** Arc length (mm). */
  readonly at_mm: number;
};

/** A straight distance between two points. */
export type SavedRuler = {
  /** Position of one end. */
  readonly from: Vector;
  /** Position of the other end. */
  readonly to: Vector;
};

/** The grid of a scan. */
export type SavedScan = {
  /** Number of voxels along (i, j, k). */
  readonly size: Vector;
  /** World position (LPS, mm) of a continuous index, row by row. */
  readonly world_from_index: ReadonlyArray<ReadonlyArray<number>>;
};

/** Everything in a session file except the lines. */
export type SavedSession = {
  /** Grid of the scan, by which the scan is recognised; None if there was no scan. */
  readonly scan: SavedScan | null;
  /** State of each vessel. */
  readonly vessels: ReadonlyArray<SavedVessel>;
  /** Branches that were found from a seed, and that the reader has not accepted yet. */
  readonly doubtful: ReadonlyArray<SavedBranch>;
  /** Spheres that traced vessels must not enter. */
  readonly stoppers: ReadonlyArray<SavedStopper>;
  /** Whether tracing may cross stretches without lumen by straight bridges. */
  readonly bridge: boolean;
  /** Straight distances that the reader measured. */
  readonly rulers: ReadonlyArray<SavedRuler>;
  /** FWHM of the point-spread function (mm) that the reader stated; None if it is estimated. */
  readonly fwhm_mm: number | null;
  /** The view of the scan, if saved. */
  readonly view: SavedView | null;
  /** Whether a voxel spacing of 1 mm was assumed; exists since version 2. */
  readonly one_millimetre_assumed?: boolean;
  /** Whether the context hides bone; exists since version 2. */
  readonly bone_hidden?: boolean;
  /** Whether tracing looks for dark lumens; exists since version 2. */
  readonly dark?: boolean;
  /** The scan that the reader compares with this one; exists since version 2. */
  readonly compared?: SavedComparison;
};

/** A sphere that traced vessels must not enter. */
export type SavedStopper = {
  /** Centre. */
  readonly center: Vector;
  /** Radius (mm). */
  readonly radius_mm: number;
};

/** The state of a vessel, except its line. */
export type SavedVessel = {
  /** Colour as `#rrggbb`. */
  readonly color: string;
  /** Whether the vessel is hidden in all views. */
  readonly hidden: boolean;
  /** Clicks in order; None if the vessel was not traced from clicks. */
  readonly clicks: ReadonlyArray<Vector> | null;
  /** Marks that the reader set, if any. */
  readonly marks: SavedMarks | null;
  /** Contours that the reader drew: arc length, centre (to the right and down in the section), and distances from the centre at equal angles; exist since version 2. */
  readonly contours_mm?: ReadonlyArray<ReadonlyArray<number>>;
};

/** The view of a scan. */
export type SavedView = {
  /** Camera of the 3D view. */
  readonly camera: SavedCamera;
  /** Reformation: `csr`, `csr-paper`, `mpcpr` or `cr`. */
  readonly method: string;
  /** Values of settings that differ from the default, by name; a window is level and width. */
  readonly settings: Settings;
  /** Layout of the page. */
  readonly layout: string;
  /** Position of the cross-hair, if it is shown. */
  readonly cross_hair: Vector | null;
  /** The vessel that is shown straightened, and the place whose cross-section is shown. */
  readonly picked: SavedPlace | null;
  /** The planes of the slices, if they were turned or are thick; exist since version 2. */
  readonly slices?: Slices;
};

/** A scale bar of round length. */
export type ScaleBar = {
  /** Length (mm). */
  readonly length: number;
  /** The label above the bar. */
  readonly words: string;
  /** Length in pixels; may be fractional. */
  readonly pixels: number;
};

/** What the header of a scan states about patient and modality; empty where it states nothing. */
export type ScanIdentity = {
  /** PatientID without padding. */
  readonly patient: string;
  /** IssuerOfPatientID without padding. */
  readonly issuer: string;
  /** Modality. */
  readonly modality: string;
};

/** A vessel measured in an earlier and a later scan. */
export type ScansToCompare = {
  /** The records of both profiles, as `profile_record` answers them. */
  readonly records: readonly [string, string];
  /** Places that belong together (arc lengths on both vessels, mm). */
  readonly pairs: ReadonlyArray<Pair>;
  readonly vessel: string;
  /** What the scans are called. */
  readonly scans: readonly [string, string];
  readonly identities: readonly [ScanIdentity, ScanIdentity];
  /** Whether scans of two patients are compared. */
  readonly other_patient: boolean;
  /** Whether scans and patients are named. */
  readonly is_named: boolean;
  /** Pictures of the earlier and the later scan for the report (PNG in base64); may be empty. */
  readonly pictures: ReadonlyArray<string>;
};

export type Sentence = {
  readonly kind: SentenceKind;
  readonly words: string;
};

export type SentenceKind = "finding" | "doubt" | "remark";

/** A session as the page stores it: lines by number, and everything else as in the file, without the data of points. */
export type SessionContent = {
  readonly lines: ReadonlyArray<NamedLine>;
  readonly doubtful_lines: ReadonlyArray<NamedLine>;
  readonly session: SavedSession;
};

export type SettingRow = {
  readonly name: string;
  readonly kind: string;
  readonly optional: boolean;
  readonly default: SettingValue;
  readonly low: number | null;
  readonly high: number | null;
  /** The unit, if the value is a number with a unit. */
  readonly unit: string | null;
  readonly choices: ReadonlyArray<string>;
  /** What the setting means if it is unset, for settings that are unset by default. */
  readonly open: string | null;
  readonly sentence: string;
};

export type Side = {
  readonly direction: Vector;
  readonly up: Vector;
};

/** Unit vectors of a slice, to the right and down. */
export type SliceAxes = {
  /** To the right in the slice. */
  readonly right: Vector;
  /** Down in the slice. */
  readonly down: Vector;
};

/** The planes of the slices; all go through the cross-hair. */
export type Slices = {
  /** The plane that is axial at first. */
  readonly axial: SliceAxes;
  /** The plane that is coronal at first. */
  readonly coronal: SliceAxes;
  /** The plane that is sagittal at first. */
  readonly sagittal: SliceAxes;
  /** Thickness (mm) and mode of a slab centred on each plane: `max`, `mean` or `min`. */
  readonly slab: readonly [number, string] | null;
};

/** A place on a vessel (arc length, mm) and its diameter (mm). */
export type Spot = {
  readonly at: number;
  readonly diameter: number;
};

/** What is known about the scan's grid, from its file or by an assumption of the reader. */
export type Stated = {
  /** Whether the voxel spacing is known; otherwise lengths have no unit. */
  readonly has_units: boolean;
  /** Whether the orientation is known; otherwise C-arm angles are omitted. */
  readonly has_orientation: boolean;
};

export type Stenosis = {
  /** By how much the stenosis is narrower than the reference (percent). */
  readonly percent: number;
  /** The standard deviation of `percent`. */
  readonly percent_uncertainty: number | null;
  /** The place of the stenosis (arc length, mm). */
  readonly at: number;
  readonly diameter: number;
  /** The standard deviation of `diameter` (mm). */
  readonly uncertainty: number | null;
  /** The reference value, in the method's unit. */
  readonly reference: number;
  readonly references: ReadonlyArray<Spot>;
  readonly method: StenosisMethod;
  /** The percentage in one line; Python's `str(stenosis)` adds the doubts. */
  readonly words: string;
  /** Doubts about the percentage, one sentence each. */
  readonly doubts: ReadonlyArray<string>;
  /** The severity group with its source, if a territory was stated and the method has groups. */
  readonly group: string | null;
};

export type Stopper = {
  readonly center: Vector;
  /** Radius of the stopper (mm). */
  readonly radius: number;
};

export type StraightenedPick = {
  readonly point: Vector;
  /** The volume's value; none outside. */
  readonly value: number | null;
  readonly vessel: number;
  /** The arc length (mm). */
  readonly arc_length: number;
};

export type Stretch = {
  /** Length along the vessel (mm). */
  readonly length: number;
  /** Straight distance between the ends (mm). */
  readonly straight: number;
  /** `length` / `straight`; null for a closed stretch. */
  readonly tortuosity: number | null;
  readonly direction: Vector;
  /** LAO angle of a C-arm that shows the stretch without foreshortening (radians). */
  readonly lao: number;
  /** Cranial angle of that C-arm (radians). */
  readonly cranial: number;
  /** The angles as displayed on a C-arm: `RAO 20° CRAN 5°`. */
  readonly c_arm: string;
  readonly view: Look;
};

/** The layout of the straightened vessel, which lies above its chart. */
export type StripLayout = {
  /** Width across the vessel (mm). */
  readonly width: number;
  /** Pixel side of the picture (mm). */
  readonly spacing: number;
  /** Height (plot pixels). */
  readonly height: number;
  /** Height relative to the scale along the vessel; 1 is true to scale. */
  readonly stretch: number;
};

/** A tick: its pixel on the axis, and its words without unit. */
export type Tick = {
  readonly at: number;
  readonly words: string;
};

export type Told = {
  readonly vessel: number;
  /** A sentence with name, length and joined vessels. */
  readonly words: string;
  readonly doubts: ReadonlyArray<DoubtfulPlace>;
};

export type VesselDocument = {
  /** The vessels in list order. */
  readonly vessels: ReadonlyArray<DocumentVessel>;
  readonly stoppers: ReadonlyArray<Stopper>;
  /** Whether tracing bridges stretches without visible lumen. */
  readonly bridge: boolean;
  /** Whether the context hides bone. */
  readonly bone_hidden: boolean;
  /** Whether tracing looks for lumens that are darker than the tissue around them. */
  readonly dark: boolean;
};

/** A doubt about a vessel that was found, with its place. */
export type VesselDoubt = {
  readonly line: number;
  readonly kind: string;
  /** A sentence that states the reason of the doubt. */
  readonly words: string;
  /** The arc length (mm) from which, or up to which, the vessel is doubtful, to show and cut there; none for the whole line. */
  readonly at: number | null;
};

export type VesselReport = {
  readonly line: number;
  /** Name; may be empty. */
  readonly name: string;
  readonly length: number;
  readonly has_radius: boolean;
};

/** A requested view. */
export type View = {
  /** The camera. */
  readonly camera: Camera;
  /** One of the names of [`METHODS`]. */
  readonly method: Method;
  /** Settings by name. */
  readonly settings: Settings;
  /** The measured vessels with a reader's marks, for a rim. */
  readonly vessels?: ReadonlyArray<MeasuredVessel>;
};

export type VolumeReport = {
  /** Voxels along (i, j, k). */
  readonly size: Vector;
  /** Affine from voxel indices to world positions (LPS, mm), row by row. */
  readonly world_from_index: ReadonlyArray<ReadonlyArray<number>>;
  readonly corners: ReadonlyArray<Vector>;
  /** Smallest voxel side (mm). */
  readonly smallest_side: number;
  /** Pixel side of reformations if none is chosen (mm). */
  readonly pixel_side: number;
  /** How the scan was made, in words. */
  readonly scan: string;
  /** Doubt about its size or axes, which concerns every picture. */
  readonly doubt: string | null;
  /** Notes for the user, this doubt included. */
  readonly notes: ReadonlyArray<string>;
};

export type WholeVessel = {
  /** The points of the vessel's line (mm, LPS). */
  readonly points: ReadonlyArray<Vector>;
  /** Length and joined vessels, such as `84.2 mm, joins Vessel 2 at 12 mm`. */
  readonly words: string;
};

export type Windows = {
  readonly main: Pair;
  readonly contexts: Readonly<Record<string, Pair>>;
  readonly presets: ReadonlyArray<NamedWindow>;
  /** Whether the values seem to be Hounsfield units, so that CT windows apply. */
  readonly is_hounsfield: boolean;
  /** Whether the stent window is useful: the values seem to be Hounsfield units, and some are as bright as metal. */
  readonly may_hold_stents: boolean;
};

/** The bytes of a written file. */
export type WrittenFile = {
  /** The content. */
  readonly bytes: Bytes;
};

/** The questions that the engine answers, by their names. */
export type Questions = {
  /** The state of the open volume and vessels. */
  readonly report: {
    readonly message: null;
    readonly answer: Report;
  };
  /** Closes the study. */
  readonly close: {
    readonly message: null;
    readonly answer: null;
  };
  /** Opens a centerline file; returns notes, and doubts about its space and unit. */
  readonly open_centerlines: {
    readonly message: {
      readonly name: string;
      readonly wish: CenterlineWish;
    };
    readonly answer: OpenedLines;
  };
  /** The camera of a named view, fitted to the study. */
  readonly fitted: {
    readonly message: {
      readonly view: string;
      readonly size: Pair;
    };
    readonly answer: Camera;
  };
  /** The view that shows most of a line, fitted to it, with little turning from this camera. */
  readonly best_view: {
    readonly message: {
      readonly camera: Camera;
      readonly line: number;
    };
    readonly answer: Camera;
  };
  /** Length, calibre and connections of the given lines. */
  readonly line_facts: {
    readonly message: {
      readonly lines: ReadonlyArray<number>;
    };
    readonly answer: ReadonlyArray<LineFacts>;
  };
  /** The views about a place on a vessel (arc length, mm), with the cut diameters. */
  readonly turn_about: {
    readonly message: {
      readonly vessel: number;
      readonly at: number;
      readonly size: Pair;
    };
    readonly answer: PlaceTurn;
  };
  /** What the colours of a view's rim mean; fails with the reason if there is none. */
  readonly rim_legend: {
    readonly message: {
      readonly view: View;
    };
    readonly answer: Legend;
  };
  /** What a pixel shows. */
  readonly pick: {
    readonly message: {
      readonly view: View;
      readonly pixel: Pair;
    };
    readonly answer: Pick;
  };
  /** The brightest voxel on the ray of a pixel. */
  readonly brightest: {
    readonly message: {
      readonly view: View;
      readonly pixel: Pair;
    };
    readonly answer: Pick;
  };
  /** The value at a point, and the vessel in which the point lies. */
  readonly at: {
    readonly message: Vector;
    readonly answer: Pick;
  };
  /** The histogram of the volume. */
  readonly histogram: {
    readonly message: {
      readonly bins: number;
    };
    readonly answer: Histogram;
  };
  /** The picture of a plane through the volume, with the given window. */
  readonly slice: {
    readonly message: {
      readonly plane: Plane;
      readonly window: Pair;
    };
    readonly answer: Picture;
  };
  /** The section at an arc length (mm); a measured section, if the vessel was measured: centre, unit vectors right and down. */
  readonly across: {
    readonly message: {
      readonly vessel: number;
      readonly at: number;
    };
    readonly answer: readonly [Vector, Vector, Vector];
  };
  /** The straightened CPR of a vessel, with the given window. */
  readonly straightened: {
    readonly message: {
      readonly cpr: Cpr;
      readonly window: Pair;
    };
    readonly answer: Picture;
  };
  /** What a pixel of the last straightened CPR shows; for CFA, the place on the half circle of the pixel. */
  readonly pick_straightened: {
    readonly message: {
      readonly pixel: Pair;
    };
    readonly answer: StraightenedPick;
  };
  /** Column and row of a point in the last straightened CPR; null if there is none. */
  readonly on_straightened: {
    readonly message: Vector;
    readonly answer: Pair | null;
  };
  /** Another reformation of the scan, fitted into a pane of this size. */
  readonly reformed: {
    readonly message: {
      readonly reformation: Reformation;
      readonly size: Pair;
      readonly window: Pair;
    };
    readonly answer: ReformedPicture;
  };
  /** What a pixel of the last reformation shows; null if it shows nothing. */
  readonly pick_reformed: {
    readonly message: {
      readonly pixel: Pair;
    };
    readonly answer: Pick | null;
  };
  /** Column and row of a point in the last reformation; null if it does not show the point. */
  readonly on_reformed: {
    readonly message: Vector;
    readonly answer: Pair | null;
  };
  /** The initial document: the opened vessels, with ids from 1. */
  readonly begin_document: {
    readonly message: null;
    readonly answer: VesselDocument;
  };
  /** Makes an edit of vessels; returns the state after it. To add a mask, the viewer reads its file first. */
  readonly edit: {
    readonly message: EditRequest;
    readonly answer: AfterEdit;
  };
  /** What a first click hits, and the whole vessel that it would add. Rejects a place where no vessel can begin: outside the scan, or with a value that is not lumen. */
  readonly first_click: {
    readonly message: {
      readonly click: Vector;
      readonly vessels: ReadonlyArray<DocumentVessel>;
    };
    readonly answer: FirstClick;
  };
  /** The lumens along a ray, the nearest first, or the lumen at a place. */
  readonly lumens: {
    readonly message: PointedAt;
    readonly answer: ReadonlyArray<PointedLumen>;
  };
  /** The path through voxel centres to the pointer; null if not found within 40 ms. Missing lumen does not cause an error. */
  readonly path: {
    readonly message: PathRequest;
    readonly answer: ReadonlyArray<Vector> | null;
  };
  /** The whole vessel that a click would add; null if there is none, or if the scan's vessels were not searched for yet. */
  readonly whole_vessel: {
    readonly message: {
      readonly click: Vector;
      readonly vessels: ReadonlyArray<DocumentVessel>;
    };
    readonly answer: WholeVessel | null;
  };
  /** The points of a line, with their radii and other data. */
  readonly line: {
    readonly message: {
      readonly line: number;
    };
    readonly answer: LineContent;
  };
  /** The points of a line after a move by hand from an arc length (mm) to a place. Nothing is kept. */
  readonly bent: {
    readonly message: {
      readonly line: number;
      readonly at: number;
      readonly to: Vector;
    };
    readonly answer: ReadonlyArray<Vector>;
  };
  /** The points of a line after smoothing by a Gaussian (standard deviation in mm). Nothing is kept. */
  readonly smoothed: {
    readonly message: {
      readonly line: number;
      readonly sigma: number;
    };
    readonly answer: ReadonlyArray<Vector>;
  };
  /** Adds a line, such as a line of a saved session; returns the number that it gets. */
  readonly add_line: {
    readonly message: LineContent;
    readonly answer: number;
  };
  /** Shows the lines of a list that are not hidden, in order; only the volume if the list is empty. All listed lines are measured together. Windows stay unchanged. The context may hide bone, and tracing may look for dark lumens. */
  readonly show: {
    readonly message: {
      readonly lines: ReadonlyArray<ListedLine>;
      readonly bone_hidden: boolean;
      readonly dark: boolean;
    };
    readonly answer: Report;
  };
  /** Writes these lines to a centerline file. */
  readonly write_lines: {
    readonly message: {
      readonly lines: ReadonlyArray<NamedLine>;
      readonly kind: string;
    };
    readonly answer: WrittenFile;
  };
  /** The profile of a shown line, measured in steps of 0.5 mm with this point-spread width (mm); null estimates the width. */
  readonly profile: {
    readonly message: {
      readonly line: number;
      readonly fwhm: number | null;
    };
    readonly answer: Profile;
  };
  /** The result at a line's marked place: the stenosis, or why it is not graded. */
  readonly grade: {
    readonly message: {
      readonly line: number;
      readonly marks: Marks;
    };
    readonly answer: Grade;
  };
  /** The doubts that a percentage would have if it were graded from these places, one sentence each. */
  readonly doubts: {
    readonly message: {
      readonly line: number;
      readonly compared: Compared;
    };
    readonly answer: ReadonlyArray<string>;
  };
  /** The references that are offered before and after the stenosis, on sides without a marked reference. */
  readonly offered_references: {
    readonly message: {
      readonly line: number;
      readonly marks: Marks;
    };
    readonly answer: readonly [Spot | null, Spot | null];
  };
  /** The diameter at an arc length (mm). */
  readonly diameter_at: {
    readonly message: {
      readonly line: number;
      readonly at: number;
    };
    readonly answer: Diameter;
  };
  /** The section nearest to an arc length (mm). */
  readonly measured_section: {
    readonly message: {
      readonly line: number;
      readonly at: number;
    };
    readonly answer: MeasuredSection;
  };
  /** The contour of the section nearest to an arc length (mm), drawn by hand: `contour`, or else the one that counts, after a pull to a point, if there is one. Nothing is kept. */
  readonly drawn_contour: {
    readonly message: {
      readonly line: number;
      readonly at: number;
      readonly contour: ReadonlyArray<number> | null;
      readonly to: Vector | null;
    };
    readonly answer: DrawnContour;
  };
  /** The stretch between two arc lengths (mm). */
  readonly stretch: {
    readonly message: {
      readonly line: number;
      readonly ends: Pair;
    };
    readonly answer: Stretch;
  };
  /** The angle between two stretches (radians); 0 for the same direction. */
  readonly angle_between: {
    readonly message: {
      readonly line: number;
      readonly first: Pair;
      readonly second: Pair;
    };
    readonly answer: number;
  };
  /** The measurements of the vessels, as the CSV of `lumencut measure -o x.csv`. */
  readonly profiles_csv: {
    readonly message: {
      readonly vessels: ReadonlyArray<MeasuredVessel>;
      readonly is_millimetre_assumed: boolean;
    };
    readonly answer: string;
  };
  /** The measurements of the vessels, as the JSON of `lumencut measure -o x.json`. */
  readonly profiles_json: {
    readonly message: {
      readonly vessels: ReadonlyArray<MeasuredVessel>;
      readonly is_millimetre_assumed: boolean;
    };
    readonly answer: string;
  };
  /** The record of a line's profile, for the width that was last requested. Python reads it as a `Profile`. */
  readonly profile_record: {
    readonly message: {
      readonly line: number;
    };
    readonly answer: string;
  };
  /** The findings on vessels and the straight distances (mm), in the sentences of the report. */
  readonly findings: {
    readonly message: {
      readonly vessels: ReadonlyArray<MeasuredVessel>;
      readonly distances: ReadonlyArray<number>;
      readonly stated: Stated;
    };
    readonly answer: Findings;
  };
  /** The layout of a pane with the straightened vessel and the chart of its diameters. */
  readonly measure_layout: {
    readonly message: MeasurePane;
    readonly answer: MeasureLayout;
  };
  /** The pictures needed for a vessel's report. */
  readonly report_plan: {
    readonly message: MeasuredVessel;
    readonly answer: ReportPlan;
  };
  /** The HTML report, as of `lumencut measure --report`. */
  readonly measured_report: {
    readonly message: ReportRequest;
    readonly answer: string;
  };
  /** A session file with this content. */
  readonly write_session: {
    readonly message: SessionContent;
    readonly answer: WrittenFile;
  };
  /** The content of a session file of the open scan. Its lines are kept, but not shown yet. */
  readonly read_session: {
    readonly message: {
      readonly name: string;
    };
    readonly answer: SessionContent;
  };
  /** The edge letters and scale bar of a picture. */
  readonly labels: {
    readonly message: LaidPicture;
    readonly answer: PictureLabels;
  };
  /** Warnings about the sides of a straightened volume, from the text that marks its file. */
  readonly straightened_notes: {
    readonly message: {
      readonly text: string;
    };
    readonly answer: ReadonlyArray<string>;
  };
  /** The kind of a file, from its first bytes as characters 0 to 255, and its name. */
  readonly kind_of_file: {
    readonly message: {
      readonly head: string;
      readonly name: string;
    };
    readonly answer: KnownFile;
  };
  /** The views of a flight between two cameras, at equal time steps, including both cameras. */
  readonly flight: {
    readonly message: {
      readonly from: Camera;
      readonly to: Camera;
      readonly views: number;
    };
    readonly answer: ReadonlyArray<Camera>;
  };
  /** The motion from one scan to another, from their corners and from pairs of points that belong together. */
  readonly motion_between: {
    readonly message: {
      readonly corners: readonly [ReadonlyArray<Vector>, ReadonlyArray<Vector>];
      readonly pairs: ReadonlyArray<readonly [Vector, Vector]>;
    };
    readonly answer: Motion;
  };
  /** A vessel in two scans, compared, with charts of this size (plot pixels). */
  readonly compare_scans: {
    readonly message: {
      readonly scans: ScansToCompare;
      readonly size: Pair;
    };
    readonly answer: ComparedScans;
  };
  /** The comparison of a vessel in two scans as a file, as of `lumencut compare-scans`. */
  readonly comparison_file: {
    readonly message: {
      readonly scans: ScansToCompare;
      readonly kind: string;
    };
    readonly answer: string;
  };
  /** The control points of a named transfer function in a window. */
  readonly transfer_points: {
    readonly message: {
      readonly name: string;
      readonly window: Pair;
    };
    readonly answer: ReadonlyArray<ControlPoint>;
  };
  /** The table of settings. */
  readonly settings_table: {
    readonly message: null;
    readonly answer: ReadonlyArray<SettingRow>;
  };
  /** The looks: named groups of settings. */
  readonly looks: {
    readonly message: null;
    readonly answer: ReadonlyArray<LookRow>;
  };
  /** The looks by body region: look, window and slab. */
  readonly regions: {
    readonly message: null;
    readonly answer: ReadonlyArray<RegionRow>;
  };
  /** The reasons why a found vessel is doubtful. */
  readonly doubt_rows: {
    readonly message: null;
    readonly answer: ReadonlyArray<DoubtRow>;
  };
};

/** When each question is answered, and what its progress is called. */
export const TURNS = {
  report: { when: 'later', words: null },
  close: { when: 'first', words: null },
  open_centerlines: { when: 'first', words: null },
  fitted: { when: 'first', words: null },
  best_view: { when: 'first', words: null },
  line_facts: { when: 'first', words: null },
  turn_about: { when: 'first', words: null },
  rim_legend: { when: 'later', words: null },
  pick: { when: 'first', words: null },
  brightest: { when: 'first', words: null },
  at: { when: 'first', words: null },
  histogram: { when: 'later', words: null },
  slice: { when: 'first', words: null },
  across: { when: 'first', words: null },
  straightened: { when: 'first', words: null },
  pick_straightened: { when: 'first', words: null },
  on_straightened: { when: 'later', words: null },
  reformed: { when: 'first', words: null },
  pick_reformed: { when: 'first', words: null },
  on_reformed: { when: 'later', words: null },
  begin_document: { when: 'first', words: null },
  edit: { when: 'first', words: 'Tracing' },
  first_click: { when: 'first', words: null },
  lumens: { when: 'first', words: null },
  path: { when: 'first', words: null },
  whole_vessel: { when: 'first', words: null },
  line: { when: 'first', words: null },
  bent: { when: 'first', words: null },
  smoothed: { when: 'first', words: null },
  add_line: { when: 'first', words: null },
  show: { when: 'first', words: null },
  write_lines: { when: 'first', words: null },
  profile: { when: 'first', words: null },
  grade: { when: 'first', words: null },
  doubts: { when: 'first', words: null },
  offered_references: { when: 'first', words: null },
  diameter_at: { when: 'first', words: null },
  measured_section: { when: 'first', words: null },
  drawn_contour: { when: 'first', words: null },
  stretch: { when: 'first', words: null },
  angle_between: { when: 'first', words: null },
  profiles_csv: { when: 'first', words: null },
  profiles_json: { when: 'first', words: null },
  profile_record: { when: 'first', words: null },
  findings: { when: 'first', words: null },
  measure_layout: { when: 'first', words: null },
  report_plan: { when: 'first', words: null },
  measured_report: { when: 'first', words: null },
  write_session: { when: 'first', words: null },
  read_session: { when: 'first', words: null },
  labels: { when: 'at once', words: null },
  straightened_notes: { when: 'at once', words: null },
  kind_of_file: { when: 'at once', words: null },
  flight: { when: 'at once', words: null },
  motion_between: { when: 'at once', words: null },
  compare_scans: { when: 'at once', words: null },
  comparison_file: { when: 'at once', words: null },
  transfer_points: { when: 'at once', words: null },
  settings_table: { when: 'at once', words: null },
  looks: { when: 'at once', words: null },
  regions: { when: 'at once', words: null },
  doubt_rows: { when: 'at once', words: null },
} as const satisfies Record<keyof Questions, Turn>;
