//! Profiles as JSON for programs, with full precision; null means not measured.

use lumencut_core::named::Named;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::outer_volume::OuterStretch;
use lumencut_vessels::measure::stenosis::suggestions::Spot;
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use serde_json::ser::PrettyFormatter;

use crate::measure_words::{of_doubts, of_flags, of_flap, of_outer_wall, of_source, of_wall};
use crate::not_measured::{NotMeasured, not_measured};
use crate::not_suggested::not_suggested;
use crate::profile_marks::{Grade, Mark, Measured, REFERENCE, marks};
use crate::profile_table::columns;
use crate::scan_details::ScanDetails;

/// The notice in every file.
pub const NOTICE: &str = "Lumencut is not a medical device.";

/// The request of a measurement; the places belong to the only vessel with marks.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Asked {
    /// Distance of sections (mm).
    pub step_mm: f64,
    /// Point-spread width (mm), if given.
    pub fwhm_mm: Option<f64>,
    /// The place of the stenosis (arc length, mm).
    pub at_mm: Option<f64>,
    /// The references of the stenosis (arc lengths, mm).
    pub reference_mm: Option<Vec<f64>>,
    /// The method's name.
    pub method: Option<String>,
    /// The assumed original diameter (mm).
    pub original_mm: Option<f64>,
    /// The diameter of a comparable normal vessel (mm).
    pub comparison_mm: Option<f64>,
    /// The territory of the severity groups.
    pub group: Option<String>,
}

/// One profile as JSON.
pub fn profile_json(profile: &Profile, scan: &ScanDetails) -> String {
    document(&ProgramProfile::of(profile, scan))
}

/// Measured vessels as JSON, with the request.
pub fn vessels_json(asked: &Asked, vessels: &[Measured]) -> String {
    #[derive(Serialize)]
    struct Vessels<'a> {
        settings: &'a Asked,
        vessels: Vec<VesselRecord>,
    }
    document(&Vessels { settings: asked, vessels: vessels.iter().map(VesselRecord::of).collect() })
}

/// A JSON document with the version of the software and the notice.
pub(crate) fn document<T: Serialize>(content: &T) -> String {
    #[derive(Serialize)]
    struct Document<'a, T> {
        software: String,
        notice: &'static str,
        #[serde(flatten)]
        content: &'a T,
    }
    let software = format!("lumencut {}", env!("CARGO_PKG_VERSION"));
    let whole = Document { software, notice: NOTICE, content };
    let mut text = Vec::new();
    let mut writer = serde_json::Serializer::with_formatter(&mut text, PrettyFormatter::with_indent(b" "));
    // Writing to memory cannot fail, and neither can numbers and texts.
    let written = whole.serialize(&mut writer);
    debug_assert!(written.is_ok(), "{written:?}");
    text.push(b'\n');
    String::from_utf8(text).unwrap_or_default()
}

#[derive(Serialize)]
struct VesselRecord {
    id: String,
    name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    suggested_name: Option<String>,
    #[serde(flatten)]
    profile: ProgramProfile,
    stenosis: Option<StenosisRecord>,
    not_graded: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    assumed: Option<&'static str>,
}

impl VesselRecord {
    fn of(one: &Measured) -> Self {
        Self {
            id: one.id.clone(),
            name: one.name.clone(),
            suggested_name: one.suggested_name.clone(),
            profile: ProgramProfile::of(one.profile, one.scan),
            stenosis: one.grade.and_then(StenosisRecord::of),
            not_graded: one.grade.and_then(Grade::not_graded).map(str::to_owned),
            assumed: one.assumed(),
        }
    }
}

#[derive(Serialize)]
struct ProgramProfile {
    scan: ScanDetails,
    fwhm_mm: f64,
    fwhm_uncertainty_mm: f64,
    fwhm_source: String,
    wall_source: String,
    noise: f64,
    length_mm: f64,
    not_measured: Vec<NotMeasured>,
    longest_diameter: Option<Longest>,
    outer_stretch: Option<OuterRecord>,
    suggestions: Suggestions,
    sections: Sections,
}

impl ProgramProfile {
    fn of(profile: &Profile, scan: &ScanDetails) -> Self {
        let longest = |spot: Spot| Longest { arc_length_mm: spot.at, diameter_max_mm: spot.diameter };
        Self {
            scan: scan.clone(),
            fwhm_mm: profile.fwhm,
            fwhm_uncertainty_mm: profile.fwhm_deviation,
            fwhm_source: of_source(&profile.fwhm_source),
            wall_source: of_wall(&profile.wall_source),
            noise: profile.noise,
            length_mm: profile.length(),
            not_measured: not_measured(profile),
            longest_diameter: profile.offered_widest().map(longest),
            outer_stretch: profile.outer_stretch().map(OuterRecord::from),
            suggestions: Suggestions::of(profile),
            sections: Sections::of(profile),
        }
    }
}

#[derive(Serialize)]
struct Longest {
    arc_length_mm: f64,
    diameter_max_mm: f64,
}

/// The longest stretch that shows the outer wall around thrombus or plaque.
#[derive(Serialize)]
struct OuterRecord {
    from_mm: f64,
    to_mm: f64,
    widest_at_mm: f64,
    diameter_outer_mm: f64,
    diameter_outer_uncertainty_mm: f64,
    volume_mm3: f64,
    volume_uncertainty_mm3: f64,
}

impl From<OuterStretch> for OuterRecord {
    fn from(OuterStretch { ends, widest, volume }: OuterStretch) -> Self {
        Self {
            from_mm: ends[0],
            to_mm: ends[1],
            widest_at_mm: widest[0],
            diameter_outer_mm: widest[1],
            diameter_outer_uncertainty_mm: widest[2],
            volume_mm3: volume[0],
            volume_uncertainty_mm3: volume[1],
        }
    }
}

#[derive(Serialize)]
struct PlaceRecord {
    arc_length_mm: f64,
    diameter_mm: f64,
}

impl From<&Mark> for PlaceRecord {
    fn from(mark: &Mark) -> Self {
        Self { arc_length_mm: mark.at, diameter_mm: mark.diameter }
    }
}

/// A place without a clear wall, and the largest diameter that its values allow.
#[derive(Serialize)]
struct ThroatRecord {
    arc_length_mm: f64,
    at_most_mm: f64,
}

impl From<Spot> for ThroatRecord {
    fn from(throat: Spot) -> Self {
        Self { arc_length_mm: throat.at, at_most_mm: throat.diameter }
    }
}

#[derive(Serialize)]
struct Suggestions {
    narrowest: Option<PlaceRecord>,
    throat: Option<ThroatRecord>,
    references: Vec<PlaceRecord>,
    not_suggested: Vec<String>,
}

impl Suggestions {
    fn of(profile: &Profile) -> Self {
        // Places are suggested only at sections that count.
        let found = marks(profile, None, &[]).unwrap_or_default();
        let is_reference = |mark: &&Mark| mark.name == REFERENCE;
        let narrowest = found.iter().find(|mark| !is_reference(mark) && mark.diameter.is_finite());
        let narrowest = narrowest.map(PlaceRecord::from);
        let throat = profile.throat().map(ThroatRecord::from);
        let references = found.iter().filter(is_reference).map(PlaceRecord::from).collect();
        Self { narrowest, throat, references, not_suggested: not_suggested(profile, None, &[]) }
    }
}

struct Sections {
    numbers: Vec<(&'static str, Vec<f64>)>,
    outer_wall: Vec<&'static str>,
    flap: Vec<&'static str>,
    counts: Vec<bool>,
    flags: Vec<Vec<String>>,
}

impl Sections {
    fn of(profile: &Profile) -> Self {
        Self {
            numbers: columns(profile).into_iter().chain(axes(profile)).collect(),
            outer_wall: profile.outer_wall.iter().map(|one| of_outer_wall(*one)).collect(),
            flap: profile.flap.iter().map(|one| of_flap(*one)).collect(),
            counts: (0..profile.len()).map(|n| profile.counts(n)).collect(),
            flags: profile.flags.iter().map(|flags| of_flags(*flags)).collect(),
        }
    }
}

/// The planes of the sections: unit vectors right and down (LPS).
fn axes(profile: &Profile) -> impl Iterator<Item = (&'static str, Vec<f64>)> {
    const NAMES: [[&str; 3]; 2] =
        [["right_x_lps", "right_y_lps", "right_z_lps"], ["down_x_lps", "down_y_lps", "down_z_lps"]];
    let along = |which: usize, axis: usize| profile.axes.iter().map(|axes| axes[which][axis]).collect();
    (0..6).map(move |n| (NAMES[n / 3][n % 3], along(n / 3, n % 3)))
}

impl Serialize for Sections {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (name, values) in &self.numbers {
            map.serialize_entry(name, values)?;
        }
        map.serialize_entry("outer_wall", &self.outer_wall)?;
        map.serialize_entry("flap", &self.flap)?;
        map.serialize_entry("counts", &self.counts)?;
        map.serialize_entry("flags", &self.flags)?;
        map.end()
    }
}

#[derive(Serialize)]
struct StenosisRecord {
    percent: f64,
    percent_uncertainty: f64,
    method: &'static str,
    at_mm: f64,
    diameter_mm: f64,
    uncertainty_mm: f64,
    reference_mm: f64,
    references: Vec<PlaceRecord>,
    group: Option<String>,
    doubts: Vec<String>,
}

impl StenosisRecord {
    fn of(grade: &Grade) -> Option<Self> {
        let graded = grade.stenosis()?;
        let place = |[at, diameter]: &[f64; 2]| PlaceRecord { arc_length_mm: *at, diameter_mm: *diameter };
        Some(Self {
            percent: graded.percent,
            percent_uncertainty: graded.percent_uncertainty,
            method: graded.method.name(),
            at_mm: graded.at,
            diameter_mm: graded.diameter,
            uncertainty_mm: graded.uncertainty,
            reference_mm: graded.reference,
            references: graded.references.iter().map(place).collect(),
            group: grade.group().map(str::to_owned),
            doubts: of_doubts(&graded.doubts),
        })
    }
}
