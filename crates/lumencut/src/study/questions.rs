//! The questions of a viewer to the study, as a table. The page's types are generated from it, see [`crate::study::asking`].

use lumencut_vessels::measure::profile::Profile;

use crate::file_kinds::{KnownFile, kind_of};
use crate::report::Stated;
use crate::straightened_sides::StraightenedSides;
use crate::study::after_edit::{AfterEdit, FirstClick};
use crate::study::along::LegendMessage;
use crate::study::asking::{Answer, Answering, Asking, Turn, WrittenFile, questions, read};
use crate::study::centerline_files::{AskedMessage, OpenedLines};
use crate::study::content::Report;
use crate::study::contours::DrawnContour;
use crate::study::document::{Document, DocumentVessel};
use crate::study::doubts::{DoubtRow, doubt_rows};
use crate::study::edits::EditMessage;
use crate::study::failure::{Failure, Result};
use crate::study::histogram::Histogram;
use crate::study::labels::{LaidPicture, PictureLabels};
use crate::study::line_facts::LineFacts;
use crate::study::lines::{LineContent, ListedLine, NamedLine};
use crate::study::lumens::{PointedLumen, PointedMessage};
use crate::study::measure_layout::{MeasureLayout, MeasurePaneMessage};
use crate::study::measure_messages::{
    ComparedMessage, DiameterMessage, GradeMessage, MarksMessage, ProfileMessage, SectionMessage,
    SpotMessage, StretchMessage, VesselMessage,
};
use crate::study::open_study::{Picture, Study};
use crate::study::outlines::Contour;
use crate::study::picking::Pick;
use crate::study::place_turn::PlaceTurn;
use crate::study::planes::Plane;
use crate::study::reformations::{ReformationMessage, ReformedPicture};
use crate::study::regions::{RegionRow, regions};
use crate::study::report_messages::{Findings, ReportMessage};
use crate::study::reshaping::Reshaping;
use crate::study::session_files::SessionContent;
use crate::study::settings::{LookRow, PointMessage, SettingRow, looks, preset_points, rows};
use crate::study::straightened::CprMessage;
use crate::study::straightening::StraightenedPick;
use crate::study::tracing::PathMessage;
use crate::study::two_scans::{ComparedScans, MotionMessage, ScansMessage};
use crate::study::view::{CameraMessage, ViewMessage, views_between};
use crate::study::whole_vessel::WholeVessel;

type Vector = [f64; 3];

/// Level and width.
type Window = [f64; 2];

/// Time limit (ms) of the search for a path, which runs while the pointer moves.
const PATH_TIME_LIMIT_MS: f64 = 40.0;

questions! { |study, asking|
of_the_study {
    /// The state of the open volume and vessels.
    [Turn::Later] report(_nothing: ()) -> Report = study.report()?;

    /// Closes the study.
    [Turn::First] close(_nothing: ()) -> () = study.close();

    /// Opens a centerline file; returns notes, and doubts about its space and unit.
    [Turn::First] open_centerlines { name: String, wish: AskedMessage } -> OpenedLines =
        study.open_centerlines(asking.bytes, &name, wish)?;

    /// The camera of a named view, fitted to the study.
    [Turn::First] fitted { view: String, size: [usize; 2] } -> CameraMessage = study.fitted(&view, size)?;

    /// The view that shows most of a line, fitted to it, with little turning from this camera.
    [Turn::First] best_view { camera: CameraMessage, line: usize } -> CameraMessage =
        study.best_view(&camera, line)?;

    /// Length, calibre and connections of the given lines.
    [Turn::First] line_facts { lines: Vec<usize> } -> Vec<LineFacts> = study.line_facts(&lines)?;

    /// The views about a place on a vessel (arc length, mm), with the cut diameters.
    [Turn::First] turn_about { vessel: usize, at: f64, size: [usize; 2] } -> PlaceTurn =
        study.turn_about(vessel, at, size, asking.watch.stop)?;

    /// What the colours of a view's rim mean; fails with the reason if there is none.
    [Turn::Later] rim_legend { view: ViewMessage } -> LegendMessage = study.rim_legend(&view)?;

    /// What a pixel shows.
    [Turn::First] pick { view: ViewMessage, pixel: [f64; 2] } -> Pick = study.pick(&study.view_of(&view)?, pixel)?;

    /// The brightest voxel on the ray of a pixel.
    [Turn::First] brightest { view: ViewMessage, pixel: [f64; 2] } -> Pick = study.brightest(&study.view_of(&view)?, pixel)?;

    /// The value at a point, and the vessel in which the point lies.
    [Turn::First] at(point: Vector) -> Pick = study.at(point);

    /// The histogram of the volume.
    [Turn::Later] histogram { bins: usize } -> Histogram = study.histogram(bins)?;

    /// The picture of a plane through the volume, with the given window.
    [Turn::First] slice { plane: Plane, window: Window } -> Picture = study.slice(&plane, window)?;

    /// The section at an arc length (mm); a measured section, if the vessel was measured: centre, unit vectors right and down.
    [Turn::First] across { vessel: usize, at: f64 } -> [Vector; 3] = study.across(vessel, at)?;

    /// The straightened CPR of a vessel, with the given window.
    [Turn::First] straightened { cpr: CprMessage, window: Window } -> Picture = study.straightened(cpr, (window, asking.watch.stop))?;

    /// What a pixel of the last straightened CPR shows; for CFA, the place on the half circle of the pixel.
    [Turn::First] pick_straightened { pixel: [f64; 2] } -> StraightenedPick = study.pick_straightened(pixel)?;

    /// Column and row of a point in the last straightened CPR; null if there is none.
    [Turn::Later] on_straightened(point: Vector) -> Option<[f64; 2]> = study.on_straightened(point);

    /// Another reformation of the scan, fitted into a pane of this size.
    [Turn::First] reformed { reformation: ReformationMessage, size: [usize; 2], window: Window } -> ReformedPicture =
        study.reformed(reformation, size, (window, asking.watch.stop))?;

    /// What a pixel of the last reformation shows; null if it shows nothing.
    [Turn::First] pick_reformed { pixel: [f64; 2] } -> Option<Pick> = study.pick_reformed(pixel)?;

    /// Column and row of a point in the last reformation; null if it does not show the point.
    [Turn::Later] on_reformed(point: Vector) -> Option<[f64; 2]> = study.on_reformed(point);

    /// The initial document: the opened vessels, with ids from 1.
    [Turn::First] begin_document(_nothing: ()) -> Document = study.begin_document();

    /// Makes an edit of vessels; returns the state after it. To add a mask, the viewer reads its file first.
    [Turn::Long("Tracing")] edit(message: EditMessage) -> AfterEdit = study.edit_and_show(&message, asking.watch)?;

    /// What a first click hits, and the whole vessel that it would add. Rejects a place where no vessel can begin: outside the
    /// scan, or with a value that is not lumen.
    [Turn::First] first_click { click: Vector, vessels: Vec<DocumentVessel> } -> FirstClick =
        study.first_click(click, &vessels)?;

    /// The lumens along a ray, the nearest first, or the lumen at a place.
    [Turn::First] lumens(pointed: PointedMessage) -> Vec<PointedLumen> = study.lumens(&pointed)?;

    /// The path through voxel centres to the pointer; null if not found within 40 ms. Missing lumen does not cause an error.
    [Turn::First] path(request: PathMessage) -> Option<Vec<Vector>> = {
        let end = (asking.clock)() + PATH_TIME_LIMIT_MS;
        study.path(&request, &|| (asking.clock)() >= end)?
    };

    /// The whole vessel that a click would add; null if there is none, or if the scan's vessels were not searched for yet.
    [Turn::First] whole_vessel { click: Vector, vessels: Vec<DocumentVessel> } -> Option<WholeVessel> =
        study.whole_vessel(click, &vessels)?;

    /// The points of a line, with their radii and other data.
    [Turn::First] line { line: usize } -> LineContent = study.line(line)?;

    /// The points of a line after a move by hand from an arc length (mm) to a place. Nothing is kept.
    [Turn::First] bent { line: usize, at: f64, to: Vector } -> Vec<Vector> =
        study.reshaped(line, &Reshaping::Bend { at, to })?;

    /// The points of a line after smoothing by a Gaussian (standard deviation in mm). Nothing is kept.
    [Turn::First] smoothed { line: usize, sigma: f64 } -> Vec<Vector> =
        study.reshaped(line, &Reshaping::Smooth { sigma })?;

    /// Adds a line, such as a line of a saved session; returns the number that it gets.
    [Turn::First] add_line(content: LineContent) -> usize = study.add_line(content)?;

    /// Shows the lines of a list that are not hidden, in order; only the volume if the list is empty. All listed lines are measured
    /// together. Windows stay unchanged. The context may hide bone, and tracing may look for dark lumens.
    [Turn::First] show { lines: Vec<ListedLine>, bone_hidden: bool, dark: bool } -> Report = {
        study.trace_dark(dark);
        study.hide_bone(bone_hidden, &lines, asking.watch)?;
        study.show(&lines)?;
        study.report()?
    };

    /// Writes these lines to a centerline file.
    [Turn::First] write_lines { lines: Vec<NamedLine>, kind: String } -> WrittenFile =
        WrittenFile { bytes: study.write(&lines, &kind)? };

    /// The profile of a shown line, measured in steps of 0.5 mm with this point-spread width (mm); null estimates the width.
    [Turn::First] profile { line: usize, fwhm: Option<f64> } -> ProfileMessage =
        study.profile(line, fwhm, asking.watch.stop)?.into();

    /// The result at a line's marked place: the stenosis, or why it is not graded.
    [Turn::First] grade { line: usize, marks: MarksMessage } -> GradeMessage =
        GradeMessage::of(&marks.marked()?, measured(study, line, asking)?);

    /// The doubts that a percentage would have if it were graded from these places, one sentence each.
    [Turn::First] doubts { line: usize, compared: ComparedMessage } -> Vec<String> =
        compared.doubts(measured(study, line, asking)?)?;

    /// The references that are offered before and after the stenosis, on sides without a marked reference.
    [Turn::First] offered_references { line: usize, marks: MarksMessage } -> [Option<SpotMessage>; 2] =
        marks.marked()?.offered_references(measured(study, line, asking)?)?.map(|spot| spot.map(SpotMessage::from));

    /// The diameter at an arc length (mm).
    [Turn::First] diameter_at { line: usize, at: f64 } -> DiameterMessage =
        measured(study, line, asking)?.diameter_at(at)?.into();

    /// The section nearest to an arc length (mm).
    [Turn::First] measured_section { line: usize, at: f64 } -> SectionMessage =
        SectionMessage::nearest(measured(study, line, asking)?, at);

    /// The contour of the section nearest to an arc length (mm), drawn by hand: `contour`, or else the one that counts, after a pull to
    /// a point, if there is one. Nothing is kept.
    [Turn::First] drawn_contour { line: usize, at: f64, contour: Option<Contour>, to: Option<Vector> } -> DrawnContour =
        study.drawn_contour(line, at, (contour, to), asking.watch.stop)?;

    /// The stretch between two arc lengths (mm).
    [Turn::First] stretch { line: usize, ends: [f64; 2] } -> StretchMessage =
        StretchMessage::between(measured(study, line, asking)?, ends)?;

    /// The angle between two stretches (radians); 0 for the same direction.
    [Turn::First] angle_between { line: usize, first: [f64; 2], second: [f64; 2] } -> f64 =
        measured(study, line, asking)?.angle_between(first, second)?;

    /// The measurements of the vessels, as the CSV of `lumencut measure -o x.csv`.
    [Turn::First] profiles_csv { vessels: Vec<VesselMessage>, is_millimetre_assumed: bool } -> String =
        study.profiles_csv(&vessels, is_millimetre_assumed, asking.watch.stop)?;

    /// The measurements of the vessels, as the JSON of `lumencut measure -o x.json`.
    [Turn::First] profiles_json { vessels: Vec<VesselMessage>, is_millimetre_assumed: bool } -> String =
        study.profiles_json(&vessels, is_millimetre_assumed, asking.watch.stop)?;

    /// The record of a line's profile, for the width that was last requested. Python reads it as a `Profile`.
    [Turn::First] profile_record { line: usize } -> String = study.profile_record(line, asking.watch.stop)?;

    /// The findings on vessels and the straight distances (mm), in the sentences of the report.
    [Turn::First] findings { vessels: Vec<VesselMessage>, distances: Vec<f64>, stated: Stated } -> Findings =
        study.findings(&vessels, &distances, (stated, asking.watch.stop))?;

    /// The layout of a pane with the straightened vessel and the chart of its diameters.
    [Turn::First] measure_layout(pane: MeasurePaneMessage) -> MeasureLayout =
        study.measure_layout(&pane, asking.watch.stop)?;

    /// The pictures needed for a vessel's report.
    [Turn::First] report_plan(vessel: VesselMessage) -> crate::report::Plan =
        study.report_plan(&vessel, asking.watch.stop)?;

    /// The HTML report, as of `lumencut measure --report`.
    [Turn::First] measured_report(request: ReportMessage) -> String =
        study.measured_report(&request, asking.watch.stop)?;

    /// A session file with this content.
    [Turn::First] write_session(content: SessionContent) -> WrittenFile =
        WrittenFile { bytes: study.write_session(content)? };

    /// The content of a session file of the open scan. Its lines are kept, but not shown yet.
    [Turn::First] read_session { name: String } -> SessionContent = study.read_session(asking.bytes, &name)?;
}
at_once {
    /// The edge letters and scale bar of a picture.
    labels(picture: LaidPicture) -> PictureLabels = picture.into();

    /// Warnings about the sides of a straightened volume, from the text that marks its file.
    straightened_notes { text: String } -> Vec<String> =
        StraightenedSides::read(&text).map_or_else(Vec::new, |sides| sides.notes());

    /// The kind of a file, from its first bytes as characters 0 to 255, and its name.
    kind_of_file { head: String, name: String } -> KnownFile = {
        let bytes: Vec<u8> = head.chars().map(|letter| u8::try_from(u32::from(letter)).unwrap_or(b'?')).collect();
        kind_of(&bytes, &name)
    };

    /// The views of a flight between two cameras, at equal time steps, including both cameras.
    flight { from: CameraMessage, to: CameraMessage, views: usize } -> Vec<CameraMessage> =
        views_between(&from, &to, views)?;

    /// The motion from one scan to another, from their corners and from pairs of points that belong together.
    motion_between { corners: [Vec<Vector>; 2], pairs: Vec<[Vector; 2]> } -> MotionMessage =
        MotionMessage::between(&corners, &pairs)?;

    /// A vessel in two scans, compared, with charts of this size (plot pixels).
    compare_scans { scans: ScansMessage, size: [f64; 2] } -> ComparedScans = scans.answer(size)?;

    /// The comparison of a vessel in two scans as a file, as of `lumencut compare-scans`.
    comparison_file { scans: ScansMessage, kind: String } -> String = scans.file(&kind)?;

    /// The control points of a named transfer function in a window.
    transfer_points { name: String, window: Window } -> Vec<PointMessage> = preset_points(&name, window)?;

    /// The table of settings.
    settings_table(_nothing: ()) -> Vec<SettingRow> = rows();

    /// The looks: named groups of settings.
    looks(_nothing: ()) -> Vec<LookRow> = looks();

    /// The looks by body region: look, window and slab.
    regions(_nothing: ()) -> Vec<RegionRow> = regions();

    /// The reasons why a found vessel is doubtful.
    doubt_rows(_nothing: ()) -> Vec<DoubtRow> = doubt_rows();
}
}

/// The profile of a line, with the point-spread width that was last requested.
fn measured<'a>(study: &'a mut Study, line: usize, asking: &Asking) -> Result<&'a Profile> {
    study.measured(line, asking.watch.stop)
}
