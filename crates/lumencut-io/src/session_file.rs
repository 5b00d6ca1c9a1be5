//! Session files store a reader's work on a scan, so that it can be continued.
//!
//! A session file is a markups file of 3D Slicer (`.mrk.json`) whose curves are the vessels. The field
//! [`FIELD`] has everything else, but no file names or patient data. Points are in LPS, lengths in mm.
//! The page's types are generated from the types here; they skip what the page leaves to the engine.

use serde::{Deserialize, Serialize};

use crate::centerlines::Line;
use crate::error::{Error, Result, excerpt};
use crate::json::Json;
use crate::read;
use crate::write::check_all;
use crate::write::mrk_json::markups;

mod compared;
mod view;

pub use compared::ComparedScan;
pub use view::{Camera, Picked, SliceAxes, Slices, View};

/// Name of the field that is added to the markups file.
pub const FIELD: &str = "LumencutSession";

/// Versions of that field. Version 2 adds the assumed voxel spacing of 1 mm, hidden bone, contours and lines by hand,
/// noted diameters, planes of slices, and a compared scan. Files use
/// the lowest sufficient version, so that older programs reject only files that they cannot read.
const FORMATS: [u32; 2] = [1, 2];

const NOTICE: &str = "Lumencut is not a medical device.";

type Point = [f64; 3];

/// A saved session.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SessionFile {
    /// Vessels (mm, LPS), one for each of [`Session::vessels`].
    pub lines: Vec<Line>,
    /// Everything except the lines.
    pub session: Session,
}

/// Everything in a session file except the lines.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedSession"))]
#[serde(deny_unknown_fields)]
pub struct Session {
    /// Version of the field [`FIELD`].
    #[cfg_attr(feature = "types", ts(skip))]
    pub format: u32,
    /// Name and version of the program that wrote the file.
    #[cfg_attr(feature = "types", ts(skip))]
    pub software: String,
    /// Statement that the program is not a medical device.
    #[cfg_attr(feature = "types", ts(skip))]
    pub notice: String,
    /// Grid of the scan, by which the scan is recognised; None if there was no scan.
    pub scan: Option<Scan>,
    /// State of each vessel.
    pub vessels: Vec<VesselState>,
    /// Branches that were found from a seed, and that the reader has not accepted yet.
    pub doubtful: Vec<DoubtfulBranch>,
    /// Spheres that traced vessels must not enter.
    pub stoppers: Vec<Stopper>,
    /// Whether tracing may cross stretches without lumen by straight bridges.
    pub bridge: bool,
    /// Straight distances that the reader measured.
    pub rulers: Vec<Ruler>,
    /// FWHM of the point-spread function (mm) that the reader stated; None if it is estimated.
    pub fwhm_mm: Option<f64>,
    /// The view of the scan, if saved.
    pub view: Option<View>,
    /// Whether a voxel spacing of 1 mm was assumed; exists since version 2.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[cfg_attr(feature = "types", ts(as = "Option<bool>", optional))]
    pub one_millimetre_assumed: bool,
    /// Whether the context hides bone; exists since version 2.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[cfg_attr(feature = "types", ts(as = "Option<bool>", optional))]
    pub bone_hidden: bool,
    /// Whether tracing looks for dark lumens; exists since version 2.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[cfg_attr(feature = "types", ts(as = "Option<bool>", optional))]
    pub dark: bool,
    /// The scan that the reader compares with this one; exists since version 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "types", ts(optional))]
    pub compared: Option<ComparedScan>,
}

impl Session {
    fn least_format(&self) -> u32 {
        let has_diameters = |marks: &Marks| !(marks.diameters_mm.is_empty() && marks.confirmed_mm.is_empty());
        let marks = self.vessels.iter().filter_map(|vessel| vessel.marks.as_ref());
        let is_by_hand = |vessel: &VesselState| !vessel.contours_mm.is_empty() || vessel.by_hand.is_some();
        let has_contours = self.vessels.iter().any(is_by_hand);
        let has_slices = self.view.as_ref().is_some_and(|view| view.slices.is_some());
        let is_compared = self.compared.is_some();
        let has_more = self.one_millimetre_assumed
            || self.bone_hidden
            || self.dark
            || has_contours
            || has_slices
            || is_compared;
        FORMATS[usize::from(has_more || marks.into_iter().any(has_diameters))]
    }

    /// The session as JSON.
    pub fn json(&self) -> Result<String> {
        let expected = "numbers and texts that JSON can hold";
        serde_json::to_string(self).map_err(|error| Error::new(FIELD, error.to_string(), expected))
    }
}

/// The grid of a scan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedScan"))]
#[serde(deny_unknown_fields)]
pub struct Scan {
    /// Number of voxels along (i, j, k).
    pub size: [usize; 3],
    /// World position (LPS, mm) of a continuous index, row by row.
    #[cfg_attr(feature = "types", ts(type = "Array<Array<number>>"))]
    pub world_from_index: [[f64; 4]; 4],
}

/// The state of a vessel, except its line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedVessel"))]
#[serde(deny_unknown_fields)]
pub struct VesselState {
    /// Colour as `#rrggbb`.
    pub color: String,
    /// Whether the vessel is hidden in all views.
    pub hidden: bool,
    /// Clicks in order; None if the vessel was not traced from clicks.
    pub clicks: Option<Vec<Point>>,
    /// Confidence of each point, 0 to 1.
    #[cfg_attr(feature = "types", ts(skip))]
    pub confidence: Option<Vec<f64>>,
    /// Whether each point lies on a bridged stretch without lumen.
    #[cfg_attr(feature = "types", ts(skip))]
    pub bridged: Option<Vec<bool>>,
    /// Whether the reader moved each point of the line; exists since version 2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "types", ts(skip))]
    pub by_hand: Option<Vec<bool>>,
    /// Marks that the reader set, if any.
    pub marks: Option<Marks>,
    /// Contours that the reader drew: arc length, centre (to the right and down in the section), and distances from the centre at
    /// equal angles; exist since version 2.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "types", ts(as = "Option<Vec<Vec<f64>>>", optional))]
    pub contours_mm: Vec<Vec<f64>>,
}

/// Marks that the reader set on a vessel; arc lengths and diameters are in mm.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedMarks"))]
#[serde(deny_unknown_fields)]
pub struct Marks {
    /// Arc length of a stenosis.
    pub at_mm: Option<f64>,
    /// Arc lengths of the references.
    pub references_mm: Vec<f64>,
    /// Grading method: `nascet`, `ecst` or `area`.
    pub method: String,
    /// Assumed original diameter at the stenosis, for ECST.
    pub original_mm: Option<f64>,
    /// Diameter of a comparable normal vessel, for NASCET.
    pub comparison_mm: Option<f64>,
    /// Territory for grades: `carotid` or `coronary`.
    pub group: Option<String>,
    /// Arc lengths of the ends of a segment.
    pub stretch_mm: Option<[f64; 2]>,
    /// Arc lengths of the ends of a second segment.
    pub second_stretch_mm: Option<[f64; 2]>,
    /// Arc lengths of noted diameters; exist since version 2.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "types", ts(as = "Option<Vec<f64>>", optional))]
    pub diameters_mm: Vec<f64>,
    /// Arc lengths of marks that confirm suggestions; exist since version 2.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "types", ts(as = "Option<Vec<f64>>", optional))]
    pub confirmed_mm: Vec<f64>,
}

/// A doubtful branch that was found from a seed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedBranch"))]
#[serde(deny_unknown_fields)]
pub struct DoubtfulBranch {
    /// Name of the branch; may be empty.
    #[cfg_attr(feature = "types", ts(skip))]
    pub name: String,
    /// Colour as `#rrggbb`.
    pub color: String,
    /// Reason for the doubt.
    pub doubt: String,
    /// Points of the branch.
    #[cfg_attr(feature = "types", ts(skip))]
    pub points: Vec<Point>,
    /// Radius of each point (mm).
    #[cfg_attr(feature = "types", ts(skip))]
    pub radius: Option<Vec<f64>>,
    /// Confidence of each point, 0 to 1.
    #[cfg_attr(feature = "types", ts(skip))]
    pub confidence: Option<Vec<f64>>,
}

/// A sphere that traced vessels must not enter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedStopper"))]
#[serde(deny_unknown_fields)]
pub struct Stopper {
    /// Centre.
    pub center: Point,
    /// Radius (mm).
    pub radius_mm: f64,
}

/// A straight distance between two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "types", derive(ts_rs::TS), ts(rename = "SavedRuler"))]
#[serde(deny_unknown_fields)]
pub struct Ruler {
    /// Position of one end.
    pub from: Point,
    /// Position of the other end.
    pub to: Point,
}

/// Whether the content is a session file.
#[must_use]
pub fn is_session(content: &[u8]) -> bool {
    content.trim_ascii_start().starts_with(b"{")
        && Json::of(content).is_ok_and(|root| root.fields([FIELD])[0].is_some())
}

/// Reads the session file `name`. Fails for other files, an unknown version, or contradictory content.
pub fn read_session(content: &[u8], name: &str) -> Result<SessionFile> {
    read_unnamed(content, name).map_err(|error| {
        // The reader of curves has already added the name.
        if error.subject.starts_with(name) { error } else { error.in_file(name) }
    })
}

fn read_unnamed(content: &[u8], name: &str) -> Result<SessionFile> {
    let expected = "a session file of Lumencut";
    let root = Json::of(content)
        .map_err(|error| Error::truncated("", format!("damaged JSON ({error})"), expected))?;
    let [field, curves] = root.fields([FIELD, "markups"]);
    let field = field.ok_or_else(|| Error::new("", format!("no field {FIELD}"), expected))?;
    check_format(field.fields(["format"])[0].and_then(Json::number))?;
    let session: Session = serde_json::from_str(field.raw())
        .map_err(|error| Error::new(FIELD, excerpt(&error.to_string()), expected))?;
    let is_empty = curves.is_some_and(|curves| matches!(curves.each(|_, _| Ok(())), Some(Ok(0))));
    let lines = if is_empty { Vec::new() } else { read(content, name)?.lines };
    check(&lines, &session)?;
    Ok(SessionFile { lines, session })
}

/// Writes a session file, with version and notice added. Fails if lines and session contradict each other.
pub fn write_session(file: &SessionFile, software: &str) -> Result<Vec<u8>> {
    let session = Session {
        format: file.session.least_format(),
        software: software.to_owned(),
        notice: NOTICE.to_owned(),
        ..file.session.clone()
    };
    if !file.lines.is_empty() {
        check_all(&file.lines)?;
    }
    check(&file.lines, &session)?;
    Ok(markups(&file.lines, &format!("\"{FIELD}\": {},\n", session.json()?)).into_bytes())
}

fn check_format(version: Option<f64>) -> Result<()> {
    if FORMATS.iter().any(|format| version == Some(f64::from(*format))) {
        return Ok(());
    }
    let found = version.map_or_else(|| "no version".to_owned(), |version| format!("version {version}"));
    let is_newer = version.is_some_and(|version| version > f64::from(FORMATS[1]));
    let mend = if is_newer { "open it with a newer version of Lumencut; " } else { "" };
    let [first, second] = FORMATS;
    let error = Error::new(FIELD, found, format!("version {first} or {second}"));
    Err(error.mend(format!("{mend}the curves in it can still be read as centerlines")))
}

fn check(lines: &[Line], session: &Session) -> Result<()> {
    if session.format < session.least_format() {
        let what = match session {
            Session { one_millimetre_assumed: true, .. } => "an assumed millimetre",
            Session { bone_hidden: true, .. } => "hidden bone",
            Session { dark: true, .. } => "dark lumens",
            Session { vessels, .. } if vessels.iter().any(|vessel| !vessel.contours_mm.is_empty()) => {
                "contours"
            }
            Session { vessels, .. } if vessels.iter().any(|vessel| vessel.by_hand.is_some()) => {
                "a line by hand"
            }
            Session { compared: Some(_), .. } => "a compared scan",
            Session { view: Some(View { slices: Some(_), .. }), .. } => "planes of slices",
            _ => "noted diameters",
        };
        let found = format!("{what} in version {}", session.format);
        return Err(Error::new(FIELD, found, format!("version {}", session.least_format())));
    }
    if lines.len() != session.vessels.len() {
        let found = format!("{} for {} curve(s)", session.vessels.len(), lines.len());
        return Err(Error::new("vessels of the session", found, "one for each curve"));
    }
    for (number, (line, state)) in lines.iter().zip(&session.vessels).enumerate() {
        let count = line.points.len();
        let subject = format!("vessel {number} of the session");
        check_color(&subject, &state.color)?;
        check_count(&subject, "confidences", state.confidence.as_deref(), count)?;
        check_count(&subject, "bridged points", state.bridged.as_deref(), count)?;
        check_count(&subject, "points by hand", state.by_hand.as_deref(), count)?;
        if let Some(marks) = &state.marks {
            check_marks(&subject, marks)?;
        }
    }
    for (number, branch) in session.doubtful.iter().enumerate() {
        let count = branch.points.len();
        let subject = format!("doubtful branch {number} of the session");
        check_color(&subject, &branch.color)?;
        if count < 2 {
            return Err(Error::new(subject, format!("{count} point(s)"), "at least 2 points"));
        }
        check_count(&subject, "radii", branch.radius.as_deref(), count)?;
        check_count(&subject, "confidences", branch.confidence.as_deref(), count)?;
    }
    if let Some(fwhm) = session.fwhm_mm.filter(|fwhm| !(fwhm.is_finite() && *fwhm > 0.0)) {
        return Err(Error::new("FWHM of the session", fwhm.to_string(), "more than 0 mm"));
    }
    let picked = session.view.as_ref().and_then(|view| view.picked.as_ref());
    if let Some(picked) = picked.filter(|picked| picked.vessel >= lines.len()) {
        let found = format!("vessel {} of {}", picked.vessel, lines.len());
        return Err(Error::new("picked vessel of the session", found, "the number of a vessel, from 0"));
    }
    Ok(())
}

fn check_color(subject: &str, color: &str) -> Result<()> {
    let digits = color.strip_prefix('#').unwrap_or_default();
    if digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return Ok(());
    }
    Err(Error::new(format!("color of {subject}"), excerpt(color), "'#' and six hexadecimal digits"))
}

fn check_count<T>(subject: &str, what: &str, numbers: Option<&[T]>, count: usize) -> Result<()> {
    match numbers {
        Some(numbers) if numbers.len() != count => {
            let found = format!("{} for {count} points", numbers.len());
            Err(Error::new(format!("{what} of {subject}"), found, "one for each point"))
        }
        _ => Ok(()),
    }
}

fn check_marks(subject: &str, marks: &Marks) -> Result<()> {
    let methods = ["nascet", "ecst", "area"];
    if !methods.contains(&marks.method.as_str()) {
        let found = excerpt(&marks.method);
        return Err(Error::new(format!("method of {subject}"), found, methods.join(", ")));
    }
    let groups = ["carotid", "coronary"];
    if let Some(group) = marks.group.as_ref().filter(|group| !groups.contains(&group.as_str())) {
        return Err(Error::new(format!("group of {subject}"), excerpt(group), groups.join(", ")));
    }
    if marks.references_mm.len() > 2 {
        let found = format!("{} references", marks.references_mm.len());
        return Err(Error::new(subject, found, "two references at most"));
    }
    Ok(())
}
