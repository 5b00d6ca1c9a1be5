//! What was measured, as the page and its worker tell it each other: the page's types are made of these.

use crate::flag_table::{FLAGS, FlagLook};
use crate::measure_words::{of_bounds, of_c_arm, of_doubts, of_flags, of_source, of_stenosis, of_wall};
use crate::not_measured::{NotMeasured, not_measured};
use crate::not_suggested::not_suggested;
use crate::profile_marks::{Grade, Marked};
use crate::profile_record::Asked;
use glam::DVec3;
use lumencut_core::named::Named;
use lumencut_vessels::measure::groups::Territory;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::{Compared, Method};
use lumencut_vessels::measure::stretch::{towards_detector, up_at_detector};
use lumencut_vessels::measure::suggestions::Spot;
use serde::{Deserialize, Serialize};

use crate::study::failure::Result;

type Vector = [f64; 3];

/// A place on a vessel and the diameter there (mm).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Spot"))]
pub(crate) struct SpotMessage {
    /// mm along the vessel
    at: f64,
    /// mm
    diameter: f64,
}

impl From<Spot> for SpotMessage {
    fn from(spot: Spot) -> Self {
        Self { at: spot.at, diameter: spot.diameter }
    }
}

/// The lumen of a vessel by its arc length. What was not measured is NaN, null in JSON.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Profile"))]
pub(crate) struct ProfileMessage {
    /// mm
    arc_length: Vec<f64>,
    /// Of a circle of the same area (mm).
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    diameter: Vec<f64>,
    /// The shortest one (mm).
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    diameter_min: Vec<f64>,
    /// The longest one (mm).
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    diameter_max: Vec<f64>,
    /// mm²
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    area: Vec<f64>,
    /// The standard deviation of `diameter` (mm).
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    uncertainty: Vec<f64>,
    /// Whether a section counts for what is narrowest, widest or suggested.
    counts: Vec<bool>,
    /// Words such as `calcium`, `no clear wall`.
    flags: Vec<Vec<String>>,
    /// What calcium or metal beside the lumen leaves open, in words.
    bounds: Vec<Option<String>>,
    /// Every flag that there is, in the order of plots and tables.
    flag_table: &'static [FlagLook],
    /// The middle of each section.
    center: Vec<Vector>,
    /// Full width at half maximum of the point spread (mm).
    fwhm: f64,
    /// How it was found: `given`, `estimated on …`, `assumed: …`.
    fwhm_source: String,
    /// The level that walls were expected to have, or why they were not told apart.
    wall_source: String,
    /// A suggestion, not a finding.
    narrowest: Option<SpotMessage>,
    /// The longest diameter; none also where an odd outline or a branch may be what makes it so.
    widest: Option<SpotMessage>,
    /// Why no narrowest place, or no reference of it, is suggested: a sentence each.
    not_suggested: Vec<String>,
    /// The stretches that were not measured.
    not_measured: Vec<NotMeasured>,
}

impl From<&Profile> for ProfileMessage {
    fn from(profile: &Profile) -> Self {
        Self {
            arc_length: profile.arc_length.clone(),
            diameter: profile.diameter_equivalent(),
            diameter_min: profile.diameter_min.clone(),
            diameter_max: profile.diameter_max.clone(),
            area: profile.area.clone(),
            uncertainty: profile.uncertainty.clone(),
            counts: (0..profile.len()).map(|n| profile.counts(n)).collect(),
            flags: profile.flags.iter().map(|flags| of_flags(*flags)).collect(),
            bounds: profile.bounds.iter().map(|bounds| of_bounds(*bounds)).collect(),
            flag_table: &FLAGS,
            center: arrays(&profile.center),
            fwhm: profile.fwhm,
            fwhm_source: of_source(&profile.fwhm_source),
            wall_source: of_wall(&profile.wall_source),
            narrowest: profile.narrowest().map(SpotMessage::from),
            widest: profile.offered_widest().map(SpotMessage::from),
            not_suggested: not_suggested(profile, None, &[]),
            not_measured: not_measured(profile),
        }
    }
}

/// What a reader marked on one vessel (arc lengths, mm).
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Marks"))]
pub(crate) struct MarksMessage {
    /// The place of a stenosis.
    at: Option<f64>,
    /// One or two places to compare it with.
    references: Vec<f64>,
    /// How it is graded.
    #[cfg_attr(test, ts(type = "StenosisMethod"))]
    method: String,
    /// The assumed original diameter (mm), for ECST.
    original: Option<f64>,
    /// The diameter of a vessel like the normal one (mm).
    comparison: Option<f64>,
    /// The territory whose groups are told.
    #[cfg_attr(test, ts(type = "Territory | null"))]
    group: Option<String>,
    /// The ends of a stretch: its length, its C-arm.
    stretch: Option<[f64; 2]>,
    /// The ends of another stretch: the angle between both.
    #[serde(rename = "secondStretch")]
    second_stretch: Option<[f64; 2]>,
    /// Places whose diameters are noted.
    #[serde(default)]
    diameters: Vec<f64>,
}

impl MarksMessage {
    /// The stretches that were marked (mm).
    pub(crate) fn stretches(&self) -> Vec<[f64; 2]> {
        self.stretch.into_iter().chain(self.second_stretch).collect()
    }

    /// The places whose diameters are noted (mm).
    pub(crate) fn diameters(&self) -> &[f64] {
        &self.diameters
    }

    /// What was marked.
    ///
    /// # Errors
    /// `settings` for another method or territory.
    pub(crate) fn marked(&self) -> Result<Marked> {
        let method = Method::named("method of the stenosis", &self.method)?;
        let territory = self.group.as_ref().map(|name| Territory::named("vessel of the group", name));
        let compared = Compared {
            reference: self.references.clone(),
            original: self.original,
            comparison: self.comparison,
        };
        let diameters = self.diameters.clone();
        Ok(Marked { at: self.at, method, compared, group: territory.transpose()?, diameters })
    }

    /// The same as what the command line is asked for; without a graded stenosis its place alone.
    pub(crate) fn asked(&self, is_graded: bool) -> Asked {
        let only = Asked { at_mm: self.at, ..Asked::default() };
        if !is_graded {
            return only;
        }
        Asked {
            reference_mm: Some(self.references.clone()).filter(|places| !places.is_empty()),
            method: Some(self.method.clone()),
            original_mm: self.original,
            comparison_mm: self.comparison,
            group: self.group.clone(),
            ..only
        }
    }
}

/// What is told of a place that was marked; nothing where none is.
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Grade"))]
pub(crate) struct GradeMessage {
    /// The stenosis that was marked.
    stenosis: Option<StenosisMessage>,
    /// What is still missing, or what is wrong with a place.
    not_graded: Option<String>,
}

impl From<Option<Grade>> for GradeMessage {
    fn from(grade: Option<Grade>) -> Self {
        let not_graded = grade.as_ref().and_then(Grade::not_graded).map(str::to_owned);
        Self { stenosis: grade.as_ref().and_then(StenosisMessage::of), not_graded }
    }
}

/// A stenosis that is graded.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Stenosis"))]
struct StenosisMessage {
    /// How much narrower it is than the reference.
    percent: f64,
    /// The standard deviation of `percent`.
    #[cfg_attr(test, ts(type = "number | null"))]
    percent_uncertainty: f64,
    /// Its place (mm).
    at: f64,
    /// mm
    diameter: f64,
    /// The standard deviation of `diameter` (mm).
    #[cfg_attr(test, ts(type = "number | null"))]
    uncertainty: f64,
    /// What it is compared with, in the unit of the method.
    reference: f64,
    /// The places that it is compared with.
    references: Vec<SpotMessage>,
    /// How it is graded.
    #[cfg_attr(test, ts(type = "StenosisMethod"))]
    method: &'static str,
    /// The percentage in one line. Python's `str(stenosis)` has it with its doubts.
    words: String,
    /// What makes the percentage doubtful, a sentence each.
    doubts: Vec<String>,
    /// The group of the field with its source, where a territory was named.
    group: Option<String>,
}

impl StenosisMessage {
    fn of(grade: &Grade) -> Option<Self> {
        let stenosis = grade.stenosis()?;
        let spot = |[at, diameter]: &[f64; 2]| SpotMessage { at: *at, diameter: *diameter };
        Some(Self {
            percent: stenosis.percent,
            percent_uncertainty: stenosis.percent_uncertainty,
            at: stenosis.at,
            diameter: stenosis.diameter,
            uncertainty: stenosis.uncertainty,
            reference: stenosis.reference,
            references: stenosis.references.iter().map(spot).collect(),
            method: stenosis.method.name(),
            words: of_stenosis(stenosis),
            doubts: of_doubts(&stenosis.doubts),
            group: grade.group().map(str::to_owned),
        })
    }
}

/// Places that are compared before anything is graded, such as those that are offered (arc lengths, mm).
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Compared"))]
pub(crate) struct ComparedMessage {
    /// The narrow place.
    at: f64,
    /// The places that it is compared with.
    references: Vec<f64>,
    /// How it would be graded.
    #[cfg_attr(test, ts(type = "StenosisMethod"))]
    method: String,
}

impl ComparedMessage {
    /// What would make a percentage from these places doubtful, a sentence each.
    ///
    /// # Errors
    /// `settings` for another method.
    pub(super) fn doubts(&self, profile: &Profile) -> Result<Vec<String>> {
        let method = Method::named("method of the stenosis", &self.method)?;
        Ok(of_doubts(&profile.doubts(self.at, method, &self.references)))
    }
}

/// The diameter at a place and its standard deviation (mm).
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Diameter"))]
pub(crate) struct DiameterMessage {
    /// Of a circle of the same area (mm).
    pub diameter: f64,
    /// Its standard deviation (mm).
    #[cfg_attr(test, ts(type = "number | null"))]
    pub uncertainty: f64,
}

impl From<(f64, f64)> for DiameterMessage {
    fn from((diameter, uncertainty): (f64, f64)) -> Self {
        Self { diameter, uncertainty }
    }
}

/// A section: its number, its wall, and the ends of its shortest and longest diameter (mm, LPS).
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "MeasuredSection"))]
pub(crate) struct SectionMessage {
    /// Its number in the profile.
    number: usize,
    /// The points of the wall; empty where none was found.
    contour: Vec<Vector>,
    /// The ends of the shortest diameter.
    shortest: Option<[Vector; 2]>,
    /// The ends of the longest diameter.
    longest: Option<[Vector; 2]>,
}

impl SectionMessage {
    /// The section of a profile that is nearest to an arc length (mm).
    pub(super) fn nearest(profile: &Profile, at: f64) -> Self {
        let number = profile.nearest_section(at);
        let middle = profile.center[number];
        let ends =
            |axis: DVec3| axis.is_finite().then(|| [middle - axis, middle + axis].map(|p| p.to_array()));
        let [shortest, longest] = profile.half_axes[number].map(ends);
        Self { number, contour: arrays(&profile.contour[number]), shortest, longest }
    }
}

/// From where a stretch is seen.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Look"))]
pub(crate) struct LookMessage {
    /// From the viewer into the scene.
    direction: Vector,
    /// Upwards.
    up: Vector,
}

/// A marked stretch of a vessel.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Stretch"))]
pub(crate) struct StretchMessage {
    /// Along the vessel (mm).
    length: f64,
    /// From end to end (mm).
    straight: f64,
    /// `length` in straight distances; null where it ends where it begins.
    #[cfg_attr(test, ts(type = "number | null"))]
    tortuosity: f64,
    /// Unit vector along it.
    direction: Vector,
    /// How a C-arm is turned to the left that shows it in its whole length (radians).
    lao: f64,
    /// How it is turned to the head (radians).
    cranial: f64,
    /// The same as it stands on a C-arm: `RAO 20° CRAN 5°`.
    c_arm: String,
    /// The view from the detector of that C-arm.
    view: LookMessage,
}

impl StretchMessage {
    /// The stretch between two arc lengths (mm), and the C-arm that is turned least to see it in its whole length.
    ///
    /// # Errors
    /// `measuring` for places beyond the vessel, or one place twice.
    pub(super) fn between(profile: &Profile, ends: [f64; 2]) -> Result<Self> {
        let stretch = profile.stretch(ends)?;
        let arm = profile.c_arm(ends, None)?;
        let view = LookMessage {
            direction: (-towards_detector(arm)).to_array(),
            up: up_at_detector(arm).to_array(),
        };
        Ok(Self {
            length: stretch.length,
            straight: stretch.straight,
            tortuosity: stretch.tortuosity(),
            direction: profile.direction(ends)?.to_array(),
            lao: arm.lao,
            cranial: arm.cranial,
            c_arm: of_c_arm(&arm),
            view,
        })
    }
}

/// A vessel for tables.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "MeasuredVessel"))]
pub(crate) struct VesselMessage {
    /// Its id.
    pub(crate) id: String,
    /// Its name, empty where it has none.
    pub name: String,
    /// Its line.
    pub line: usize,
    /// What was marked on it.
    pub(crate) marks: MarksMessage,
}

fn arrays(points: &[DVec3]) -> Vec<Vector> {
    points.iter().map(DVec3::to_array).collect()
}
