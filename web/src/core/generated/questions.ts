/** What the engine is asked and answers, written of `crates/lumencut/src/study/questions.rs` by `make types`; a test says where it is stale. */
import type { Bytes, Pair, Settings, SettingValue, Turn, Vector } from '../plain';
import type { SavedSession } from '../session-file';

export type Method = 'csr' | 'csr-paper' | 'cr' | 'mpcpr';
export type StenosisMethod = 'nascet' | 'ecst' | 'area';
export type Territory = 'carotid' | 'coronary';

/** An edit that was made, and what is shown after it. */
export type AfterEdit = {
  /** What came of it. */
  readonly edited: Edited;
  /** What is open now: the vessels of the document that are not doubtful are shown, as `show` shows them. */
  readonly report: Report;
  /** The lines that came to the document. */
  readonly lines: ReadonlyArray<NumberedLine>;
  /** What is known of the lines that are not doubtful, as `line_facts` tells it. */
  readonly facts: ReadonlyArray<LineFacts>;
  /** What lies where the edit was made; none of an edit that has no place. */
  readonly pick: Pick | null;
};

/** A camera: orthographic, its axes unit vectors. */
export type Camera = {
  /** What is in the middle of the picture. */
  readonly center: Vector;
  /** From the viewer into the scene. */
  readonly direction: Vector;
  /** Upwards. */
  readonly up: Vector;
  /** Columns and rows. */
  readonly size: Pair;
  /** The side of a pixel (mm). */
  readonly pixel_spacing: number;
};

/** In which space and unit centerlines are to be read, by names; what is left out is not asked for. */
export type CenterlineWish = {
  /** `lps` or `ras`. */
  readonly coordinates?: string;
  /** `um`, `mm`, `cm`, `dm` or `m`. */
  readonly unit?: string;
  /** Whether the points of each line are put into their order. */
  readonly reorder?: boolean;
};

/** Places that are compared before anything is graded, such as those that are offered (arc lengths, mm). */
export type Compared = {
  /** The narrow place. */
  readonly at: number;
  /** The places that it is compared with. */
  readonly references: ReadonlyArray<number>;
  /** How it would be graded. */
  readonly method: StenosisMethod;
};

/** A CPR as the page asks for it. */
export type Cpr = {
  /** The vessel's number. */
  readonly vessel: number;
  /** The rotation about its axis (radians). */
  readonly angle: number;
  /** The width of the picture (mm). */
  readonly width: number;
  /** The side of a pixel (mm). */
  readonly pixel_spacing: number;
  /** Which value of a half circle a pixel shows, by CFA; without one its own. */
  readonly feature: Feature | null;
  /** Which side of the lumen each row follows; without one all rows have the same angle. */
  readonly roll: Roll | null;
};

/** The diameter at a place and its standard deviation (mm). */
export type Diameter = {
  /** Of a circle of the same area (mm). */
  readonly diameter: number;
  /** Its standard deviation (mm). */
  readonly uncertainty: number | null;
};

/** A vessel that the reader sees in the list. */
export type DocumentVessel = {
  /** Stays the same through edits; never given twice in a study. */
  readonly id: number;
  /** The number of its line. */
  readonly line: number;
  /** Its name; empty where it has none. */
  readonly name: string;
  /** `#rrggbb`. */
  readonly color: string;
  /** Whether the views leave it out. */
  readonly isHidden: boolean;
  /** Where it was clicked, in order along it; none where it came from a file, a mask or a seed, or was cut or joined. */
  readonly clicks: ReadonlyArray<Vector> | null;
  /** Why a branch from a seed is doubtful: it is shown apart until it is accepted. None where it is not. */
  readonly doubt: string | null;
};

/** A reason for doubt. */
export type DoubtRow = {
  /** What a vessel of a document and a session file say, as a part of a sentence. */
  readonly words: string;
  /** The same in a word or two. */
  readonly short: string;
};

/** Where a line is doubtful. */
export type DoubtfulPlace = {
  /** Why, in a sentence. */
  readonly words: string;
  /** From which arc length on, or up to which (mm): where it can be looked at and cut. None where all of the line is meant. */
  readonly at: number | null;
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

/** An edit of vessels. Clicks and stoppers are numbered from 0, arc lengths are in mm. */
export type Edit = {
  readonly "kind": "begin_vessel";
  /** In order along it. */
  readonly clicks: ReadonlyArray<Vector>;
} | {
  readonly "kind": "add_click";
  /** The vessel. */
  readonly id: number;
  /** Where it is. */
  readonly point: Vector;
} | {
  readonly "kind": "add_click_on_line";
  /** The vessel. */
  readonly id: number;
  /** A point of its line. */
  readonly point: Vector;
} | {
  readonly "kind": "move_click";
  /** The vessel. */
  readonly id: number;
  /** Which of its clicks. */
  readonly number: number;
  /** Where it is now. */
  readonly point: Vector;
} | {
  readonly "kind": "remove_click";
  /** The vessel. */
  readonly id: number;
  /** Which of its clicks. */
  readonly number: number;
} | {
  readonly "kind": "add_stopper";
  /** Its center. */
  readonly center: Vector;
} | {
  readonly "kind": "move_stopper";
  /** Which of them. */
  readonly number: number;
  /** Its center now. */
  readonly center: Vector;
} | {
  readonly "kind": "remove_stopper";
  /** Which of them. */
  readonly number: number;
} | {
  readonly "kind": "set_bridge";
  /** Whether they do from now on. */
  readonly bridge: boolean;
} | {
  readonly "kind": "cut";
  /** The vessel. */
  readonly id: number;
  /** The arc length of the cut. */
  readonly at: number;
} | {
  readonly "kind": "join";
  /** The first vessel. */
  readonly id: number;
  /** The second one. */
  readonly other: number;
} | {
  readonly "kind": "remove";
  /** Which of them. */
  readonly ids: ReadonlyArray<number>;
} | {
  readonly "kind": "add_branches";
  /** A place in a vessel. */
  readonly seed: Vector;
} | {
  readonly "kind": "add_whole_vessel";
  /** A place in the vessel. */
  readonly click: Vector;
} | {
  readonly "kind": "find_vessels";
  /** Whether doubtful ones are wanted also where none is sure; else that is refused. */
  readonly doubtful: boolean;
} | {
  readonly "kind": "accept";
  /** Which of them. */
  readonly ids: ReadonlyArray<number>;
} | {
  readonly "kind": "leave_out";
  /** Which of them. */
  readonly ids: ReadonlyArray<number>;
} | {
  readonly "kind": "add_mask"
} | {
  readonly "kind": "add_lines";
  /** In their order. */
  readonly lines: ReadonlyArray<NamedLine>;
};

/** What a host asks for: an edit of a document. */
export type EditRequest = {
  /** The document as it is. */
  readonly document: VesselDocument;
  /** What is done to it. */
  readonly edit: Edit;
  /** Whether gaps are bridged from now on, as part of the same step: what mends an edit that was refused by `bridge`. */
  readonly bridging: boolean;
};

/** What came of an edit. */
export type Edited = {
  /** The document after it; the same one where there was nothing to do. */
  readonly document: VesselDocument;
  /** The name of the step that can be undone. */
  readonly words: string;
  /** The vessels that came to it, by their ids. */
  readonly added: ReadonlyArray<number>;
  /** The vessels whose marks are lost, by their ids: they are gone, or their places lie elsewhere. */
  readonly without_marks: ReadonlyArray<number>;
  /** What was odd, one sentence each. */
  readonly notes: ReadonlyArray<string>;
  /** What is told of the vessel that was traced; none after an edit that traces no single one. */
  readonly told: Told | null;
};

/** The features of CFA by their names. */
export type Feature = "max" | "mean" | "min";

/** What was found on a vessel. */
export type Finding = {
  /** Its line. */
  readonly line: number;
  /** The same sentences that the report has, in their order. */
  readonly sentences: ReadonlyArray<Sentence>;
};

/** What was found in a scan. */
export type Findings = {
  /** On each of the vessels, in their order. */
  readonly vessels: ReadonlyArray<Finding>;
  /** Straight distances, a sentence each. */
  readonly distances: ReadonlyArray<string>;
};

/** What a first click of a vessel hit. */
export type FirstClick = {
  /** What lies there. */
  readonly pick: Pick;
  /** The whole vessel that it would add, as `whole_vessel` tells it. */
  readonly whole: WholeVessel | null;
};

/** A flag of a section. */
export type FlagLook = {
  /** What tables and reports call it, such as `no clear wall`. */
  readonly word: string;
  /** What it means, as a part of a sentence. */
  readonly meaning: string;
  /** Its colour on a dark screen, `#rrggbb`. */
  readonly screen: string;
};

/** What is told of a place that was marked; nothing where none is. */
export type Grade = {
  /** The stenosis that was marked. */
  readonly stenosis: Stenosis | null;
  /** What is still missing, or what is wrong with a place. */
  readonly not_graded: string | null;
};

/** How many voxels are in each of equally wide ranges of values. */
export type Histogram = {
  /** The smallest value. */
  readonly low: number;
  /** The largest value. */
  readonly high: number;
  /** The number of voxels of each range, the lowest first; the largest value counts to the last. */
  readonly counts: ReadonlyArray<number>;
};

/** How a picture lies: unit vectors to the right and downwards (LPS), its width in pixels and their side (mm). */
export type LaidPicture = {
  /** To the right. */
  readonly right: Vector;
  /** Downwards. */
  readonly down: Vector;
  /** Pixels. */
  readonly width: number;
  /** The side of a pixel (mm). */
  readonly pixel_spacing: number;
};

/** A line as the page has it; `null` stands for a radius that is not known. */
export type LineContent = {
  /** At least two. */
  readonly points: ReadonlyArray<Vector>;
  /** mm; null where it is not known, of all points or of one */
  readonly radius: ReadonlyArray<number | null> | null;
  /** How sure each point is, from 0 to 1, where the line was traced. */
  readonly confidence: ReadonlyArray<number> | null;
  /** Which points lie on a stretch without lumen that was bridged, where that is known. */
  readonly bridged: ReadonlyArray<boolean> | null;
};

/** What is known of a line among others. */
export type LineFacts = {
  /** The number of the line. */
  readonly line: number;
  /** mm */
  readonly length: number;
  /** The median diameter of its points (mm); null where no radius is known. */
  readonly calibre: number | null;
  /** Which of the parts that hang together it belongs to; 0 is the longest. */
  readonly part: number;
  /** The line among them that it hangs on, as a branch on its trunk; null for the widest line of a part. */
  readonly parent: number | null;
};

/** A line as a viewer lists it. One that is hidden is not drawn; it is measured among all the same, so that hiding a vessel changes no number. */
export type ListedLine = {
  /** Its number. */
  readonly line: number;
  /** Its name; empty where it has none. */
  readonly name: string;
  /** Whether it is hidden. */
  readonly hidden: boolean;
};

/** From where a stretch is seen. */
export type Look = {
  /** From the viewer into the scene. */
  readonly direction: Vector;
  /** Upwards. */
  readonly up: Vector;
};

/** A look for viewers: several settings under one name. */
export type LookRow = {
  /** Its name on the command line and in Python. */
  readonly name: string;
  /** What its button is called. */
  readonly words: string;
  /** What it shows. */
  readonly sentence: string;
  /** The values of all settings that some look chooses: of those that this one leaves alone, the defaults. */
  readonly settings: Settings;
};

/** What a lumen map shows. */
export type MapOf = "wall" | "radius" | "thickness";

/** A name at a place of a picture. */
export type Mark = {
  /** The name. */
  readonly words: string;
  /** Column and row. */
  readonly pixel: Pair;
};

/** What a reader marked on one vessel (arc lengths, mm). */
export type Marks = {
  /** The place of a stenosis. */
  readonly at: number | null;
  /** One or two places to compare it with. */
  readonly references: ReadonlyArray<number>;
  /** How it is graded. */
  readonly method: StenosisMethod;
  /** The assumed original diameter (mm), for ECST. */
  readonly original: number | null;
  /** The diameter of a vessel like the normal one (mm). */
  readonly comparison: number | null;
  /** The territory whose groups are told. */
  readonly group: Territory | null;
  /** The ends of a stretch: its length, its C-arm. */
  readonly stretch: Pair | null;
  /** The ends of another stretch: the angle between both. */
  readonly secondStretch: Pair | null;
  /** Places whose diameters are noted. */
  readonly diameters: ReadonlyArray<number>;
};

/** A section: its number, its wall, and the ends of its shortest and longest diameter (mm, LPS). */
export type MeasuredSection = {
  /** Its number in the profile. */
  readonly number: number;
  /** The points of the wall; empty where none was found. */
  readonly contour: ReadonlyArray<Vector>;
  /** The ends of the shortest diameter. */
  readonly shortest: readonly [Vector, Vector] | null;
  /** The ends of the longest diameter. */
  readonly longest: readonly [Vector, Vector] | null;
};

/** A vessel for tables. */
export type MeasuredVessel = {
  /** Its id. */
  readonly id: string;
  /** Its name, empty where it has none. */
  readonly name: string;
  /** Its line. */
  readonly line: number;
  /** What was marked on it. */
  readonly marks: Marks;
};

/** A line with the name under which it is shown and saved. */
export type NamedLine = {
  /** Its number. */
  readonly line: number;
  /** Its name; empty where it has none. */
  readonly name: string;
};

/** A window that has a name, with its numbers for what is open. */
export type NamedWindow = {
  /** The name of the preset. */
  readonly name: string;
  /** What menus call it. */
  readonly words: string;
  /** Level and width. */
  readonly window: Pair;
};

/** A stretch of a vessel that was not measured. */
export type NotMeasured = {
  /** Where it begins (arc length, mm). */
  readonly from_mm: number;
  /** Where it ends (arc length, mm). */
  readonly to_mm: number;
  /** Where the vessel can be cut so that this stretch is off it (arc length, mm). */
  readonly cut_mm: number;
  /** That it was not measured, and why. */
  readonly words: string;
};

/** A line with its number. */
export type NumberedLine = {
  /** Its number. */
  readonly line: number;
  /** Its content. */
  readonly content: LineContent;
};

/** What is told of centerlines that were opened. */
export type OpenedLines = {
  /** What was odd about their file, one sentence each. */
  readonly notes: ReadonlyArray<string>;
  /** What speaks against the space or unit in which they were read. */
  readonly doubt: PlaceDoubt | null;
};

/** A way to where the pointer is. */
export type PathRequest = {
  /** The last click. */
  readonly from: Vector;
  /** Where the pointer is. */
  readonly to: Vector;
  /** What no vessel may pass. */
  readonly stoppers: ReadonlyArray<Stopper>;
  /** Whether stretches without lumen are bridged, however long. */
  readonly bridge: boolean;
};

/** What a pixel shows. */
export type Pick = {
  /** The world point. */
  readonly point: Vector;
  /** The volume there; none outside. */
  readonly value: number | null;
  /** The vessel in or beside whose lumen it is; none in the tissue between vessels. */
  readonly vessel: number | null;
  /** The place on the vessel that is nearest (mm). */
  readonly arc_length: number | null;
};

/** A picture: RGBA in rows from the top, and its size. */
export type Picture = {
  /** Columns and rows. */
  readonly size: Pair;
  /** A byte for each channel. */
  readonly bytes: Bytes;
};

/** What stands around a picture. */
export type PictureLabels = {
  /** The letters at its edges. */
  readonly letters: EdgeLetters;
  /** The scale bar; none where the picture has no width. */
  readonly bar: ScaleBar | null;
};

/** What speaks against the space or unit of centerlines, and how else they can be read. */
export type PlaceDoubt = {
  /** What was found, in words. */
  readonly found: string;
  /** The places that fit instead, such as `lps in cm`; none where no other fits. */
  readonly readings: ReadonlyArray<string>;
};

/** A turn about a place on a vessel, which runs upwards through the middle of the picture. */
export type PlaceTurn = {
  /** The first view: of all views about the place the one that is nearest to that from the front. */
  readonly camera: Camera;
  /** The diameter (mm) that is cut after each whole degree of the turn, from 0 to 179; from there on they repeat. None where a view has no two walls. */
  readonly diameters: ReadonlyArray<number | null>;
};

/** A flat picture as the page asks for it: the world point in its middle, unit vectors to the right and downwards (LPS), its size in pixels and their side (mm). */
export type Plane = {
  /** The world point in the middle. */
  readonly center: Vector;
  /** To the right. */
  readonly right: Vector;
  /** Downwards. */
  readonly down: Vector;
  /** Columns and rows. */
  readonly size: Pair;
  /** The side of a pixel (mm). */
  readonly pixel_spacing: number;
};

/** Where a pointer is: a place, or the ray through it. */
export type PointedAt = {
  /** The place (LPS, mm). */
  readonly point: Vector;
  /** The direction of the ray, away from the viewer (a unit vector); none where the place itself is meant. */
  readonly along: Vector | null;
};

/** A lumen that is pointed at. */
export type PointedLumen = {
  /** The place in it that is pointed at: on a ray the one that is nearest to its middle. */
  readonly point: Vector;
  /** Its middle. */
  readonly center: Vector;
  /** Its diameter (mm). */
  readonly diameter: number;
  /** The median of the values in its middle. */
  readonly value: number;
  /** The section across it, to the right. */
  readonly right: Vector;
  /** The section across it, downwards. */
  readonly down: Vector;
};

/** The lumen of a vessel by its arc length. What was not measured is NaN, null in JSON. */
export type Profile = {
  /** mm */
  readonly arc_length: ReadonlyArray<number>;
  /** Of a circle of the same area (mm). */
  readonly diameter: ReadonlyArray<number | null>;
  /** The shortest one (mm). */
  readonly diameter_min: ReadonlyArray<number | null>;
  /** The longest one (mm). */
  readonly diameter_max: ReadonlyArray<number | null>;
  /** mm² */
  readonly area: ReadonlyArray<number | null>;
  /** The standard deviation of `diameter` (mm). */
  readonly uncertainty: ReadonlyArray<number | null>;
  /** Whether a section counts for what is narrowest, widest or suggested. */
  readonly counts: ReadonlyArray<boolean>;
  /** Words such as `calcium`, `no clear wall`. */
  readonly flags: ReadonlyArray<ReadonlyArray<string>>;
  /** What calcium or metal beside the lumen leaves open, in words. */
  readonly bounds: ReadonlyArray<string | null>;
  /** Every flag that there is, in the order of plots and tables. */
  readonly flag_table: ReadonlyArray<FlagLook>;
  /** The middle of each section. */
  readonly center: ReadonlyArray<Vector>;
  /** Full width at half maximum of the point spread (mm). */
  readonly fwhm: number;
  /** How it was found: `given`, `estimated on …`, `assumed: …`. */
  readonly fwhm_source: string;
  /** The level that walls were expected to have, or why they were not told apart. */
  readonly wall_source: string;
  /** A suggestion, not a finding. */
  readonly narrowest: Spot | null;
  /** The longest diameter; none also where an odd outline or a branch may be what makes it so. */
  readonly widest: Spot | null;
  /** Why no narrowest place, or no reference of it, is suggested: a sentence each. */
  readonly not_suggested: ReadonlyArray<string>;
  /** The stretches that were not measured. */
  readonly not_measured: ReadonlyArray<NotMeasured>;
};

/** A reformation as the page asks for it. */
export type Reformation = {
  readonly "kind": "untangled";
  /** From where they are seen. */
  readonly side: Side;
} | {
  readonly "kind": "uncurl";
  /** Its number. */
  readonly vessel: number;
  /** From where it is seen. */
  readonly side: Side;
  /** From 0, as it is seen, to 1, straightened. */
  readonly amount: number;
} | {
  readonly "kind": "spiral";
  /** Its number. */
  readonly vessel: number;
  /** The angle by which sections are turned (radians). */
  readonly angle: number;
} | {
  readonly "kind": "map";
  /** Its number. */
  readonly vessel: number;
  /** What of the wall. */
  readonly of: MapOf;
};

/** The picture of a reformation. */
export type ReformedPicture = {
  /** Columns and rows. */
  readonly size: Pair;
  /** A byte for each channel. */
  readonly bytes: Bytes;
  /** What rows, columns and colours are. */
  readonly words: string;
  /** The side of a pixel (mm). */
  readonly pixel_spacing: number;
  /** Names of vessels where they end, or open into the one that is shown. */
  readonly marks: ReadonlyArray<Mark>;
};

/** A region for viewers. */
export type RegionRow = {
  /** Its name. */
  readonly name: string;
  /** What it is called. */
  readonly words: string;
  /** What it shows. */
  readonly sentence: string;
  /** The values of all settings that some look chooses. */
  readonly settings: Settings;
  /** The name of its window where the values are Hounsfield units. */
  readonly preset: string;
  /** The name of its window where they are not. */
  readonly preset_of_other_units: string;
};

/** What is open. */
export type Report = {
  /** The volume; none where vessels alone are open. */
  readonly volume: VolumeReport | null;
  /** The vessels that are shown; none where the volume alone is open. */
  readonly vessels: ReadonlyArray<VesselReport> | null;
  /** The windows that the data suggest; none without a volume. */
  readonly windows: Windows | null;
  /** Whether points of the centerlines that were read last are in another order, and may be put in order; left out where not. */
  readonly can_reorder?: boolean;
};

/** A place with its name and colour. */
export type ReportPlace = {
  /** Such as `marked place` or `reference before (suggestion)`. */
  readonly name: string;
  /** Its arc length (mm). */
  readonly at: number;
  /** Whether it is offered; a reader marked it otherwise. */
  readonly is_suggestion: boolean;
  /** Whether it is compared with the place of a stenosis. */
  readonly is_reference: boolean;
};

/** The pictures of a vessel. */
export type ReportPlan = {
  /** The width of the straightened vessel across it (mm); a host shows less where the volume has less. */
  readonly width: number;
  /** The side of its pixels (mm). */
  readonly spacing: number;
  /** The places whose sections are shown, in this order. */
  readonly places: ReadonlyArray<ReportPlace>;
  /** The side of the pictures of sections (mm). */
  readonly side: number;
};

/** A report of some vessels. */
export type ReportRequest = {
  /** A page each, in this order. */
  readonly vessels: ReadonlyArray<ReportVessel>;
  /** The name of the scan, where the user wants it there. */
  readonly scan: string | null;
  /** When it was saved, in words. */
  readonly saved: string;
  /** What is known of the scan's grid. */
  readonly stated: Stated;
  /** Whether it is the reader alone who says how far its voxels lie apart. */
  readonly is_millimetre_assumed: boolean;
  /** Level and width. */
  readonly window: Pair;
  /** The settings of the view that differ from the usual ones. */
  readonly settings: Settings;
  /** Straight distances (mm), told on the first page. */
  readonly distances: ReadonlyArray<number>;
};

/** The straightened vessel from left to right: the middle of its first column is the beginning of the vessel. */
export type ReportStrip = {
  /** A PNG in base64. */
  readonly picture: string;
  /** Columns and rows. */
  readonly size: Pair;
  /** The side of a pixel (mm). */
  readonly spacing: number;
};

/** A vessel of a report with its pictures, PNGs in base64. */
export type ReportVessel = {
  /** The vessel, with its marks. */
  readonly vessel: MeasuredVessel;
  /** A view of all vessels. */
  readonly view: ReportView;
  /** The straightened vessel. */
  readonly strip: ReportStrip;
  /** A section for each place of the plan. */
  readonly sections: ReadonlyArray<string>;
};

/** A view of all vessels. */
export type ReportView = {
  /** A PNG in base64. */
  readonly picture: string;
  /** The name of its method, such as `csr`. */
  readonly method: Method;
};

/** The sides that a roll follows, by their names. */
export type Roll = "narrowest" | "widest";

/** A bar of a length that is easily read. */
export type ScaleBar = {
  /** mm */
  readonly length: number;
  /** The length with its unit, as it stands above the bar. */
  readonly words: string;
  /** How many pixels it is long; those who draw whole pixels round it. */
  readonly pixels: number;
};

/** A sentence of what was found. */
export type Sentence = {
  /** What it tells. */
  readonly kind: SentenceKind;
  /** Its words. */
  readonly words: string;
};

/** What a sentence tells. */
export type SentenceKind = "finding" | "doubt" | "remark";

/** A session as the page has it: lines by their numbers, and all else as the file has it but for what is known at each point. */
export type SessionContent = {
  /** One for each vessel. */
  readonly lines: ReadonlyArray<NamedLine>;
  /** One for each doubtful branch. */
  readonly doubtful_lines: ReadonlyArray<NamedLine>;
  /** All but the lines. */
  readonly session: SavedSession;
};

/** A row of the table of settings. */
export type SettingRow = {
  /** Its name in Python and in files. */
  readonly name: string;
  /** What kind of value it has. */
  readonly kind: string;
  /** Whether it may be left open. */
  readonly optional: boolean;
  /** The value where nothing is chosen. */
  readonly default: SettingValue;
  /** The smallest number. */
  readonly low: number | null;
  /** The largest number. */
  readonly high: number | null;
  /** The unit of a number. */
  readonly unit: string | null;
  /** The names that can be chosen. */
  readonly choices: ReadonlyArray<string>;
  /** What holds where it is left open, for those that are open by default. */
  readonly open: string | null;
  /** What it does. */
  readonly sentence: string;
};

/** From where a view is taken that a reformation begins with. */
export type Side = {
  /** From the viewer into the scene. */
  readonly direction: Vector;
  /** Upwards. */
  readonly up: Vector;
};

/** A place on a vessel and the diameter there (mm). */
export type Spot = {
  /** mm along the vessel */
  readonly at: number;
  /** mm */
  readonly diameter: number;
};

/** What a file states of its grid, or a reader assumed. */
export type Stated = {
  /** Whether it is known how far voxels lie apart: lengths have no unit otherwise. */
  readonly has_units: boolean;
  /** Whether it is known where the patient's left is: angles of a C-arm are not told otherwise. */
  readonly has_orientation: boolean;
};

/** A stenosis that is graded. */
export type Stenosis = {
  /** How much narrower it is than the reference. */
  readonly percent: number;
  /** The standard deviation of `percent`. */
  readonly percent_uncertainty: number | null;
  /** Its place (mm). */
  readonly at: number;
  /** mm */
  readonly diameter: number;
  /** The standard deviation of `diameter` (mm). */
  readonly uncertainty: number | null;
  /** What it is compared with, in the unit of the method. */
  readonly reference: number;
  /** The places that it is compared with. */
  readonly references: ReadonlyArray<Spot>;
  /** How it is graded. */
  readonly method: StenosisMethod;
  /** The percentage in one line. Python's `str(stenosis)` has it with its doubts. */
  readonly words: string;
  /** What makes the percentage doubtful, a sentence each. */
  readonly doubts: ReadonlyArray<string>;
  /** The group of the field with its source, where a territory was named. */
  readonly group: string | null;
};

/** A ball that no vessel may pass. */
export type Stopper = {
  /** Its center. */
  readonly center: Vector;
  /** Its radius (mm). */
  readonly radius: number;
};

/** What a place in the straightened CPR shows. */
export type StraightenedPick = {
  /** The world point. */
  readonly point: Vector;
  /** The volume there; none outside. */
  readonly value: number | null;
  /** The vessel that is straightened. */
  readonly vessel: number;
  /** The place along it (mm). */
  readonly arc_length: number;
};

/** A marked stretch of a vessel. */
export type Stretch = {
  /** Along the vessel (mm). */
  readonly length: number;
  /** From end to end (mm). */
  readonly straight: number;
  /** `length` in straight distances; null where it ends where it begins. */
  readonly tortuosity: number | null;
  /** Unit vector along it. */
  readonly direction: Vector;
  /** How a C-arm is turned to the left that shows it in its whole length (radians). */
  readonly lao: number;
  /** How it is turned to the head (radians). */
  readonly cranial: number;
  /** The same as it stands on a C-arm: `RAO 20° CRAN 5°`. */
  readonly c_arm: string;
  /** The view from the detector of that C-arm. */
  readonly view: Look;
};

/** What is told of a vessel that was traced. */
export type Told = {
  /** The vessel. */
  readonly vessel: number;
  /** Its name, its length, and which vessels it joins, in a sentence. */
  readonly words: string;
  /** Where it is doubtful; none where it is not. */
  readonly doubts: ReadonlyArray<DoubtfulPlace>;
};

/** The vessels of a document, and what they are traced by. */
export type VesselDocument = {
  /** In the order of the list. */
  readonly vessels: ReadonlyArray<DocumentVessel>;
  /** Balls that no vessel may pass. */
  readonly stoppers: ReadonlyArray<Stopper>;
  /** Whether vessels go on where no lumen is seen. */
  readonly bridge: boolean;
};

/** A vessel that is shown. */
export type VesselReport = {
  /** The number of its line. */
  readonly line: number;
  /** Its name; empty where it has none. */
  readonly name: string;
  /** mm */
  readonly length: number;
  /** Whether its radius is known. */
  readonly has_radius: boolean;
};

/** A view as the page asks for it. */
export type View = {
  /** From where. */
  readonly camera: Camera;
  /** One of the names of [`METHODS`]. */
  readonly method: Method;
  /** Settings by name. */
  readonly settings: Settings;
};

/** The volume that is open. */
export type VolumeReport = {
  /** The number of voxels along (i, j, k). */
  readonly size: Vector;
  /** World position of a continuous index, row by row. */
  readonly world_from_index: ReadonlyArray<ReadonlyArray<number>>;
  /** The corners of its outermost voxels. */
  readonly corners: ReadonlyArray<Vector>;
  /** The smallest side of a voxel (mm). */
  readonly smallest_side: number;
  /** How the scan was made, in words. */
  readonly scan: string;
  /** What speaks against its lengths; none where nothing does. */
  readonly doubt: string | null;
};

/** The whole vessel that a click would add. */
export type WholeVessel = {
  /** The points of its line (mm, LPS). */
  readonly points: ReadonlyArray<Vector>;
  /** How long it is and which vessels it joins, such as `84.2 mm, joins Vessel 2 at 12 mm`. */
  readonly words: string;
};

/** The windows of what is open. */
export type Windows = {
  /** That of cut surface and flat views. */
  readonly main: Pair;
  /** Those of the contexts, by their names. */
  readonly contexts: Readonly<Record<string, Pair>>;
  /** Those that have a name, in the order to show them. */
  readonly presets: ReadonlyArray<NamedWindow>;
  /** Whether the values are Hounsfield units by what they are: the windows for CT hold for them. */
  readonly is_hounsfield: boolean;
  /** Whether the window for stents shows something: in Hounsfield units, and where values are as bright as metal. */
  readonly may_hold_stents: boolean;
};

/** The bytes of a file that is written. */
export type WrittenFile = {
  /** All of them. */
  readonly bytes: Bytes;
};

/** The questions that the engine answers, by their names. */
export type Questions = {
  /** What is open. */
  readonly report: {
    readonly message: null;
    readonly answer: Report;
  };
  /** Closes what is open. */
  readonly close: {
    readonly message: null;
    readonly answer: null;
  };
  /** Opens a file of centerlines beside the volume; tells what was odd about it, and what speaks against where it was read. */
  readonly open_centerlines: {
    readonly message: {
      readonly name: string;
      readonly wish: CenterlineWish;
    };
    readonly answer: OpenedLines;
  };
  /** The camera of a named view that shows all of the study. */
  readonly fitted: {
    readonly message: {
      readonly view: string;
      readonly size: Pair;
    };
    readonly answer: Camera;
  };
  /** The view from which most of a line is seen, fitted to it; turned least from this camera, whose size it has. */
  readonly best_view: {
    readonly message: {
      readonly camera: Camera;
      readonly line: number;
    };
    readonly answer: Camera;
  };
  /** How long and how wide lines are, and which of them hang together. */
  readonly line_facts: {
    readonly message: {
      readonly lines: ReadonlyArray<number>;
    };
    readonly answer: ReadonlyArray<LineFacts>;
  };
  /** A turn about a place on a vessel (mm), with the diameters that its views cut. */
  readonly turn_about: {
    readonly message: {
      readonly vessel: number;
      readonly at: number;
      readonly size: Pair;
    };
    readonly answer: PlaceTurn;
  };
  /** What a pixel of a view shows. */
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
  /** What lies at a point, and the vessel in whose lumen it is. */
  readonly at: {
    readonly message: Vector;
    readonly answer: Pick;
  };
  /** How the values of the volume are distributed. */
  readonly histogram: {
    readonly message: {
      readonly bins: number;
    };
    readonly answer: Histogram;
  };
  /** The picture of a plane in a window. */
  readonly slice: {
    readonly message: {
      readonly plane: Plane;
      readonly window: Pair;
    };
    readonly answer: Picture;
  };
  /** The section across a vessel at an arc length (mm), the measured one once there is one: its middle, to the right and downwards. */
  readonly across: {
    readonly message: {
      readonly vessel: number;
      readonly at: number;
    };
    readonly answer: readonly [Vector, Vector, Vector];
  };
  /** The straightened CPR of a vessel in a window. */
  readonly straightened: {
    readonly message: {
      readonly cpr: Cpr;
      readonly window: Pair;
    };
    readonly answer: Picture;
  };
  /** What a pixel of the straightened CPR shows that was asked for last; of CFA, the place on its half circle. */
  readonly pick_straightened: {
    readonly message: {
      readonly pixel: Pair;
    };
    readonly answer: StraightenedPick;
  };
  /** Column and row of a point in the straightened CPR that was asked for last; null where none was. */
  readonly on_straightened: {
    readonly message: Vector;
    readonly answer: Pair | null;
  };
  /** Another reformation than the straightened CPR, in a pane of this size. */
  readonly reformed: {
    readonly message: {
      readonly reformation: Reformation;
      readonly size: Pair;
      readonly window: Pair;
    };
    readonly answer: ReformedPicture;
  };
  /** What a pixel of the reformation shows that was asked for last; null where it shows nothing. */
  readonly pick_reformed: {
    readonly message: {
      readonly pixel: Pair;
    };
    readonly answer: Pick | null;
  };
  /** Column and row of a point in the reformation that was asked for last; null where it is not shown. */
  readonly on_reformed: {
    readonly message: Vector;
    readonly answer: Pair | null;
  };
  /** The document that the study begins with: the vessels that were opened, counted from 1. */
  readonly begin_document: {
    readonly message: null;
    readonly answer: VesselDocument;
  };
  /** What comes of an edit of vessels, and all that is shown after it; one that adds a mask comes with the files of the mask, which a viewer reads first. */
  readonly edit: {
    readonly message: EditRequest;
    readonly answer: AfterEdit;
  };
  /** What a first click of a vessel hit, and the whole vessel that it would add beside the vessels of a list. Refuses a place that no vessel can begin at: one outside of the scan, and one whose value alone shows that it is no lumen. */
  readonly first_click: {
    readonly message: {
      readonly click: Vector;
      readonly vessels: ReadonlyArray<DocumentVessel>;
    };
    readonly answer: FirstClick;
  };
  /** The lumens that are pointed at, the nearest first: those along a ray, or the one at a place. None is refused. */
  readonly lumens: {
    readonly message: PointedAt;
    readonly answer: ReadonlyArray<PointedLumen>;
  };
  /** The way to the pointer, through the middles of voxels; null where none is found within 40 ms. Never refused for places without lumen. */
  readonly path: {
    readonly message: PathRequest;
    readonly answer: ReadonlyArray<Vector> | null;
  };
  /** The whole vessel that a click would add beside the vessels of a list; null where it would add none, and until the vessels of the scan were looked for. */
  readonly whole_vessel: {
    readonly message: {
      readonly click: Vector;
      readonly vessels: ReadonlyArray<DocumentVessel>;
    };
    readonly answer: WholeVessel | null;
  };
  /** The content of a line. */
  readonly line: {
    readonly message: {
      readonly line: number;
    };
    readonly answer: LineContent;
  };
  /** Takes over a line, as from a saved session; gives its number. */
  readonly add_line: {
    readonly message: LineContent;
    readonly answer: number;
  };
  /** Shows the lines of a list that are not hidden as the vessel tree, in this order; none shows the volume alone. They are measured among all of the list. Windows stay as they were. */
  readonly show: {
    readonly message: ReadonlyArray<ListedLine>;
    readonly answer: Report;
  };
  /** A centerline file of these lines. */
  readonly write_lines: {
    readonly message: {
      readonly lines: ReadonlyArray<NamedLine>;
      readonly kind: string;
    };
    readonly answer: WrittenFile;
  };
  /** The profile of a line among the lines that are shown: kept, or measured with a step of 0.5 mm under a point spread of this width (mm); null stands for the one that is estimated. */
  readonly profile: {
    readonly message: {
      readonly line: number;
      readonly fwhm: number | null;
    };
    readonly answer: Profile;
  };
  /** What is told of the place that was marked on a line: the stenosis, or why it is not graded. */
  readonly grade: {
    readonly message: {
      readonly line: number;
      readonly marks: Marks;
    };
    readonly answer: Grade;
  };
  /** What would make a percentage from these places doubtful, a sentence each. */
  readonly doubts: {
    readonly message: {
      readonly line: number;
      readonly compared: Compared;
    };
    readonly answer: ReadonlyArray<string>;
  };
  /** The references that are offered before and after the stenosis, on sides where none is marked. */
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
  /** The section that is nearest to an arc length (mm). */
  readonly measured_section: {
    readonly message: {
      readonly line: number;
      readonly at: number;
    };
    readonly answer: MeasuredSection;
  };
  /** The stretch from one arc length to another (mm). */
  readonly stretch: {
    readonly message: {
      readonly line: number;
      readonly ends: Pair;
    };
    readonly answer: Stretch;
  };
  /** The angle between two stretches (radians): 0 where the second goes on as the first does. */
  readonly angle_between: {
    readonly message: {
      readonly line: number;
      readonly first: Pair;
      readonly second: Pair;
    };
    readonly answer: number;
  };
  /** The table that `lumencut measure -o x.csv` writes. */
  readonly profiles_csv: {
    readonly message: {
      readonly vessels: ReadonlyArray<MeasuredVessel>;
      readonly is_millimetre_assumed: boolean;
    };
    readonly answer: string;
  };
  /** What `lumencut measure -o x.json` writes. */
  readonly profiles_json: {
    readonly message: {
      readonly vessels: ReadonlyArray<MeasuredVessel>;
      readonly is_millimetre_assumed: boolean;
    };
    readonly answer: string;
  };
  /** What was found on vessels, and the straight distances (mm) of the scan, in the sentences of the report. */
  readonly findings: {
    readonly message: {
      readonly vessels: ReadonlyArray<MeasuredVessel>;
      readonly distances: ReadonlyArray<number>;
      readonly stated: Stated;
    };
    readonly answer: Findings;
  };
  /** The pictures that the report of a vessel asks for. */
  readonly report_plan: {
    readonly message: MeasuredVessel;
    readonly answer: ReportPlan;
  };
  /** The report of vessels as HTML, as `lumencut measure --report` writes it. */
  readonly measured_report: {
    readonly message: ReportRequest;
    readonly answer: string;
  };
  /** A session file of this content. */
  readonly write_session: {
    readonly message: SessionContent;
    readonly answer: WrittenFile;
  };
  /** The content of a session file of the scan that is open; its lines are held, and nothing is shown yet. */
  readonly read_session: {
    readonly message: {
      readonly name: string;
    };
    readonly answer: SessionContent;
  };
  /** The letters at the edges of a picture, and its scale bar. */
  readonly labels: {
    readonly message: LaidPicture;
    readonly answer: PictureLabels;
  };
  /** What must be known of the sides of a straightened volume, by a text of its file; nothing for another file. */
  readonly straightened_notes: {
    readonly message: {
      readonly text: string;
    };
    readonly answer: ReadonlyArray<string>;
  };
  /** As many views of a flight from one camera to another, equal times apart; the first and the last are these cameras. */
  readonly flight: {
    readonly message: {
      readonly from: Camera;
      readonly to: Camera;
      readonly views: number;
    };
    readonly answer: ReadonlyArray<Camera>;
  };
  /** The table of settings. */
  readonly settings_table: {
    readonly message: null;
    readonly answer: ReadonlyArray<SettingRow>;
  };
  /** The looks: several settings under one name each. */
  readonly looks: {
    readonly message: null;
    readonly answer: ReadonlyArray<LookRow>;
  };
  /** Looks by region of the body: a look, a window and a slab under one name. */
  readonly regions: {
    readonly message: null;
    readonly answer: ReadonlyArray<RegionRow>;
  };
  /** The reasons for which a vessel that was found is doubtful. */
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
  add_line: { when: 'first', words: null },
  show: { when: 'first', words: null },
  write_lines: { when: 'first', words: null },
  profile: { when: 'first', words: null },
  grade: { when: 'first', words: null },
  doubts: { when: 'first', words: null },
  offered_references: { when: 'first', words: null },
  diameter_at: { when: 'first', words: null },
  measured_section: { when: 'first', words: null },
  stretch: { when: 'first', words: null },
  angle_between: { when: 'first', words: null },
  profiles_csv: { when: 'first', words: null },
  profiles_json: { when: 'first', words: null },
  findings: { when: 'first', words: null },
  report_plan: { when: 'first', words: null },
  measured_report: { when: 'first', words: null },
  write_session: { when: 'first', words: null },
  read_session: { when: 'first', words: null },
  labels: { when: 'at once', words: null },
  straightened_notes: { when: 'at once', words: null },
  flight: { when: 'at once', words: null },
  settings_table: { when: 'at once', words: null },
  looks: { when: 'at once', words: null },
  regions: { when: 'at once', words: null },
  doubt_rows: { when: 'at once', words: null },
} as const satisfies Record<keyof Questions, Turn>;
