//! The table of questions that a viewer asks the study, by their names. The page's types are written of it: see
//! [`crate::study::asking`].

use lumencut_vessels::measure::profile::Profile;

use crate::report::Stated;
use crate::straightened_sides::StraightenedSides;
use crate::study::after_edit::{AfterEdit, FirstClick};
use crate::study::asking::{Answer, Answering, Asking, Turn, WrittenFile, questions, read};
use crate::study::centerline_files::{AskedMessage, OpenedLines};
use crate::study::content::Report;
use crate::study::document::{Document, DocumentVessel};
use crate::study::doubts::{DoubtRow, doubt_rows};
use crate::study::edits::EditMessage;
use crate::study::failure::{Failure, Result};
use crate::study::histogram::Histogram;
use crate::study::labels::{LaidPicture, PictureLabels};
use crate::study::line_facts::LineFacts;
use crate::study::lines::{LineContent, ListedLine, NamedLine};
use crate::study::lumens::{PointedLumen, PointedMessage};
use crate::study::measure_messages::{
    ComparedMessage, DiameterMessage, GradeMessage, MarksMessage, ProfileMessage, SectionMessage,
    SpotMessage, StretchMessage, VesselMessage,
};
use crate::study::open_study::{Picture, Study};
use crate::study::picking::Pick;
use crate::study::place_turn::PlaceTurn;
use crate::study::planes::Plane;
use crate::study::reformations::ReformationMessage;
use crate::study::reformed::ReformedPicture;
use crate::study::regions::{RegionRow, regions};
use crate::study::report_messages::{Findings, ReportMessage};
use crate::study::session_files::SessionContent;
use crate::study::settings::{LookRow, SettingRow, looks, rows};
use crate::study::straightened::CprMessage;
use crate::study::straightening::StraightenedPick;
use crate::study::tracing::PathMessage;
use crate::study::view::{CameraMessage, ViewMessage, views_between};
use crate::study::whole_vessel::WholeVessel;

type Vector = [f64; 3];

/// Level and width.
type Window = [f64; 2];

/// How long a way is looked for while the pointer moves (ms).
const PATIENCE: f64 = 40.0;

questions! { |study, asking|
of_the_study {
    /// What is open.
    [Turn::Later] report(_nothing: ()) -> Report = study.report()?;

    /// Closes what is open.
    [Turn::First] close(_nothing: ()) -> () = study.close();

    /// Opens a file of centerlines beside the volume; tells what was odd about it, and what speaks against where it was read.
    [Turn::First] open_centerlines { name: String, wish: AskedMessage } -> OpenedLines =
        study.open_centerlines(asking.bytes, &name, wish)?;

    /// The camera of a named view that shows all of the study.
    [Turn::First] fitted { view: String, size: [usize; 2] } -> CameraMessage = study.fitted(&view, size)?;

    /// The view from which most of a line is seen, fitted to it; turned least from this camera, whose size it has.
    [Turn::First] best_view { camera: CameraMessage, line: usize } -> CameraMessage =
        study.best_view(&camera, line)?;

    /// How long and how wide lines are, and which of them hang together.
    [Turn::First] line_facts { lines: Vec<usize> } -> Vec<LineFacts> = study.line_facts(&lines)?;

    /// A turn about a place on a vessel (mm), with the diameters that its views cut.
    [Turn::First] turn_about { vessel: usize, at: f64, size: [usize; 2] } -> PlaceTurn =
        study.turn_about(vessel, at, size, asking.watch.stop)?;

    /// What a pixel of a view shows.
    [Turn::First] pick { view: ViewMessage, pixel: [f64; 2] } -> Pick = study.pick(&study.view_of(&view)?, pixel)?;

    /// The brightest voxel on the ray of a pixel.
    [Turn::First] brightest { view: ViewMessage, pixel: [f64; 2] } -> Pick = study.brightest(&study.view_of(&view)?, pixel)?;

    /// What lies at a point, and the vessel in whose lumen it is.
    [Turn::First] at(point: Vector) -> Pick = study.at(point);

    /// How the values of the volume are distributed.
    [Turn::Later] histogram { bins: usize } -> Histogram = study.histogram(bins)?;

    /// The picture of a plane in a window.
    [Turn::First] slice { plane: Plane, window: Window } -> Picture = study.slice(&plane, window)?;

    /// The section across a vessel at an arc length (mm), the measured one once there is one: its middle, to the right and
    /// downwards.
    [Turn::First] across { vessel: usize, at: f64 } -> [Vector; 3] = study.across(vessel, at)?;

    /// The straightened CPR of a vessel in a window.
    [Turn::First] straightened { cpr: CprMessage, window: Window } -> Picture = study.straightened(cpr, (window, asking.watch.stop))?;

    /// What a pixel of the straightened CPR shows that was asked for last; of CFA, the place on its half circle.
    [Turn::First] pick_straightened { pixel: [f64; 2] } -> StraightenedPick = study.pick_straightened(pixel)?;

    /// Column and row of a point in the straightened CPR that was asked for last; null where none was.
    [Turn::Later] on_straightened(point: Vector) -> Option<[f64; 2]> = study.on_straightened(point);

    /// Another reformation than the straightened CPR, in a pane of this size.
    [Turn::First] reformed { reformation: ReformationMessage, size: [usize; 2], window: Window } -> ReformedPicture =
        study.reformed(reformation, size, (window, asking.watch.stop))?;

    /// What a pixel of the reformation shows that was asked for last; null where it shows nothing.
    [Turn::First] pick_reformed { pixel: [f64; 2] } -> Option<Pick> = study.pick_reformed(pixel)?;

    /// Column and row of a point in the reformation that was asked for last; null where it is not shown.
    [Turn::Later] on_reformed(point: Vector) -> Option<[f64; 2]> = study.on_reformed(point);

    /// The document that the study begins with: the vessels that were opened, counted from 1.
    [Turn::First] begin_document(_nothing: ()) -> Document = study.begin_document();

    /// What comes of an edit of vessels, and all that is shown after it; one that adds a mask comes with the files of the mask, which a
    /// viewer reads first.
    [Turn::Long("Tracing")] edit(message: EditMessage) -> AfterEdit = study.edit_and_show(&message, asking.watch)?;

    /// What a first click of a vessel hit, and the whole vessel that it would add beside the vessels of a list. Refuses a place that no
    /// vessel can begin at: one outside of the scan, and one whose value alone shows that it is no lumen.
    [Turn::First] first_click { click: Vector, vessels: Vec<DocumentVessel> } -> FirstClick =
        study.first_click(click, &vessels)?;

    /// The lumens that are pointed at, the nearest first: those along a ray, or the one at a place. None is refused.
    [Turn::First] lumens(pointed: PointedMessage) -> Vec<PointedLumen> = study.lumens(&pointed)?;

    /// The way to the pointer, through the middles of voxels; null where none is found within 40 ms. Never refused for places
    /// without lumen.
    [Turn::First] path(request: PathMessage) -> Option<Vec<Vector>> = {
        let end = (asking.clock)() + PATIENCE;
        study.path(&request, &|| (asking.clock)() >= end)?
    };

    /// The whole vessel that a click would add beside the vessels of a list; null where it would add none, and until the vessels of
    /// the scan were looked for.
    [Turn::First] whole_vessel { click: Vector, vessels: Vec<DocumentVessel> } -> Option<WholeVessel> =
        study.whole_vessel(click, &vessels)?;

    /// The content of a line.
    [Turn::First] line { line: usize } -> LineContent = study.line(line)?;

    /// Takes over a line, as from a saved session; gives its number.
    [Turn::First] add_line(content: LineContent) -> usize = study.add_line(content)?;

    /// Shows the lines of a list that are not hidden as the vessel tree, in this order; none shows the volume alone. They are measured
    /// among all of the list. Windows stay as they were.
    [Turn::First] show(lines: Vec<ListedLine>) -> Report = {
        study.show(&lines)?;
        study.report()?
    };

    /// A centerline file of these lines.
    [Turn::First] write_lines { lines: Vec<NamedLine>, kind: String } -> WrittenFile =
        WrittenFile { bytes: study.write(&lines, &kind)? };

    /// The profile of a line among the lines that are shown: kept, or measured with a step of 0.5 mm under a point spread of
    /// this width (mm); null stands for the one that is estimated.
    [Turn::First] profile { line: usize, fwhm: Option<f64> } -> ProfileMessage =
        study.profile(line, fwhm, asking.watch.stop)?.into();

    /// What is told of the place that was marked on a line: the stenosis, or why it is not graded.
    [Turn::First] grade { line: usize, marks: MarksMessage } -> GradeMessage =
        marks.marked()?.grade(measured(study, line, asking)?).into();

    /// What would make a percentage from these places doubtful, a sentence each.
    [Turn::First] doubts { line: usize, compared: ComparedMessage } -> Vec<String> =
        compared.doubts(measured(study, line, asking)?)?;

    /// The references that are offered before and after the stenosis, on sides where none is marked.
    [Turn::First] offered_references { line: usize, marks: MarksMessage } -> [Option<SpotMessage>; 2] =
        marks.marked()?.offered_references(measured(study, line, asking)?)?.map(|spot| spot.map(SpotMessage::from));

    /// The diameter at an arc length (mm).
    [Turn::First] diameter_at { line: usize, at: f64 } -> DiameterMessage =
        measured(study, line, asking)?.diameter_at(at)?.into();

    /// The section that is nearest to an arc length (mm).
    [Turn::First] measured_section { line: usize, at: f64 } -> SectionMessage =
        SectionMessage::nearest(measured(study, line, asking)?, at);

    /// The stretch from one arc length to another (mm).
    [Turn::First] stretch { line: usize, ends: [f64; 2] } -> StretchMessage =
        StretchMessage::between(measured(study, line, asking)?, ends)?;

    /// The angle between two stretches (radians): 0 where the second goes on as the first does.
    [Turn::First] angle_between { line: usize, first: [f64; 2], second: [f64; 2] } -> f64 =
        measured(study, line, asking)?.angle_between(first, second)?;

    /// The table that `lumencut measure -o x.csv` writes.
    [Turn::First] profiles_csv { vessels: Vec<VesselMessage>, is_millimetre_assumed: bool } -> String =
        study.profiles_csv(&vessels, is_millimetre_assumed, asking.watch.stop)?;

    /// What `lumencut measure -o x.json` writes.
    [Turn::First] profiles_json { vessels: Vec<VesselMessage>, is_millimetre_assumed: bool } -> String =
        study.profiles_json(&vessels, is_millimetre_assumed, asking.watch.stop)?;

    /// What was found on vessels, and the straight distances (mm) of the scan, in the sentences of the report.
    [Turn::First] findings { vessels: Vec<VesselMessage>, distances: Vec<f64>, stated: Stated } -> Findings =
        study.findings(&vessels, &distances, (stated, asking.watch.stop))?;

    /// The pictures that the report of a vessel asks for.
    [Turn::First] report_plan(vessel: VesselMessage) -> crate::report::Plan =
        study.report_plan(&vessel, asking.watch.stop)?;

    /// The report of vessels as HTML, as `lumencut measure --report` writes it.
    [Turn::First] measured_report(request: ReportMessage) -> String =
        study.measured_report(&request, asking.watch.stop)?;

    /// A session file of this content.
    [Turn::First] write_session(content: SessionContent) -> WrittenFile =
        WrittenFile { bytes: study.write_session(content)? };

    /// The content of a session file of the scan that is open; its lines are held, and nothing is shown yet.
    [Turn::First] read_session { name: String } -> SessionContent = study.read_session(asking.bytes, &name)?;
}
at_once {
    /// The letters at the edges of a picture, and its scale bar.
    labels(picture: LaidPicture) -> PictureLabels = picture.into();

    /// What must be known of the sides of a straightened volume, by a text of its file; nothing for another file.
    straightened_notes { text: String } -> Vec<String> =
        StraightenedSides::read(&text).map_or_else(Vec::new, |sides| sides.notes());

    /// As many views of a flight from one camera to another, equal times apart; the first and the last are these cameras.
    flight { from: CameraMessage, to: CameraMessage, views: usize } -> Vec<CameraMessage> =
        views_between(&from, &to, views)?;

    /// The table of settings.
    settings_table(_nothing: ()) -> Vec<SettingRow> = rows();

    /// The looks: several settings under one name each.
    looks(_nothing: ()) -> Vec<LookRow> = looks();

    /// Looks by region of the body: a look, a window and a slab under one name.
    regions(_nothing: ()) -> Vec<RegionRow> = regions();

    /// The reasons for which a vessel that was found is doubtful.
    doubt_rows(_nothing: ()) -> Vec<DoubtRow> = doubt_rows();
}
}

/// The profile of a line as it was asked for last.
fn measured<'a>(study: &'a mut Study, line: usize, asking: &Asking) -> Result<&'a Profile> {
    study.measured(line, asking.watch.stop)
}
