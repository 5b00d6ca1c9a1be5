//! What was measured, as the page and its worker tell it each other: the types of `web/src/core/measuring.ts`.

use crate::flag_table::{FLAGS, FlagLook};
use crate::measure_words::{of_c_arm, of_doubts, of_flags, of_source, of_stenosis};
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
pub struct SpotMessage {
    at: f64,
    diameter: f64,
}

impl From<Spot> for SpotMessage {
    fn from(spot: Spot) -> Self {
        Self { at: spot.at, diameter: spot.diameter }
    }
}

/// The lumen of a vessel by its arc length. What was not measured is NaN, null in JSON.
#[derive(Clone, Debug, Serialize)]
pub struct ProfileMessage<'a> {
    arc_length: &'a [f64],
    diameter: Vec<f64>,
    diameter_min: &'a [f64],
    diameter_max: &'a [f64],
    area: &'a [f64],
    uncertainty: &'a [f64],
    counts: Vec<bool>,
    flags: Vec<Vec<String>>,
    flag_table: &'static [FlagLook],
    center: Vec<Vector>,
    fwhm: f64,
    fwhm_source: String,
    narrowest: Option<SpotMessage>,
    widest: Option<SpotMessage>,
}

impl<'a> From<&'a Profile> for ProfileMessage<'a> {
    fn from(profile: &'a Profile) -> Self {
        Self {
            arc_length: &profile.arc_length,
            diameter: profile.diameter_equivalent(),
            diameter_min: &profile.diameter_min,
            diameter_max: &profile.diameter_max,
            area: &profile.area,
            uncertainty: &profile.uncertainty,
            counts: (0..profile.len()).map(|n| profile.counts(n)).collect(),
            flags: profile.flags.iter().map(|flags| of_flags(*flags)).collect(),
            flag_table: &FLAGS,
            center: arrays(&profile.center),
            fwhm: profile.fwhm,
            fwhm_source: of_source(&profile.fwhm_source),
            narrowest: profile.narrowest().map(SpotMessage::from),
            widest: profile.offered_widest().map(SpotMessage::from),
        }
    }
}

/// What a reader marked on one vessel (arc lengths, mm).
#[derive(Clone, Debug, Deserialize)]
pub struct MarksMessage {
    at: Option<f64>,
    references: Vec<f64>,
    method: String,
    original: Option<f64>,
    comparison: Option<f64>,
    group: Option<String>,
}

impl MarksMessage {
    /// What was marked.
    ///
    /// # Errors
    /// `settings` for another method or territory.
    pub fn marked(&self) -> Result<Marked> {
        let method = Method::named("method of the stenosis", &self.method)?;
        let territory = self.group.as_ref().map(|name| Territory::named("vessel of the group", name));
        let compared = Compared {
            reference: self.references.clone(),
            original: self.original,
            comparison: self.comparison,
        };
        Ok(Marked { at: self.at, method, compared, group: territory.transpose()? })
    }

    /// The same as what the command line is asked for; without a graded stenosis its place alone.
    pub fn asked(&self, is_graded: bool) -> Asked {
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
pub struct GradeMessage {
    stenosis: Option<StenosisMessage>,
    not_graded: Option<String>,
}

impl From<Option<Grade>> for GradeMessage {
    fn from(grade: Option<Grade>) -> Self {
        let not_graded = grade.as_ref().and_then(Grade::not_graded).map(str::to_owned);
        Self { stenosis: grade.as_ref().and_then(StenosisMessage::of), not_graded }
    }
}

#[derive(Clone, Debug, Serialize)]
struct StenosisMessage {
    percent: f64,
    at: f64,
    diameter: f64,
    uncertainty: f64,
    reference: f64,
    references: Vec<SpotMessage>,
    method: &'static str,
    words: String,
    doubts: Vec<String>,
    group: Option<String>,
}

impl StenosisMessage {
    fn of(grade: &Grade) -> Option<Self> {
        let stenosis = grade.stenosis()?;
        let spot = |[at, diameter]: &[f64; 2]| SpotMessage { at: *at, diameter: *diameter };
        Some(Self {
            percent: stenosis.percent,
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
pub struct ComparedMessage {
    at: f64,
    references: Vec<f64>,
    method: String,
}

impl ComparedMessage {
    /// What would make a percentage from these places doubtful, a sentence each.
    ///
    /// # Errors
    /// `settings` for another method.
    pub fn doubts(&self, profile: &Profile) -> Result<Vec<String>> {
        let method = Method::named("method of the stenosis", &self.method)?;
        Ok(of_doubts(&profile.doubts(self.at, method, &self.references)))
    }
}

/// The diameter at a place and its standard deviation (mm).
#[derive(Clone, Copy, Debug, Serialize)]
pub struct DiameterMessage {
    /// Of a circle of the same area (mm).
    pub diameter: f64,
    /// Its standard deviation (mm).
    pub uncertainty: f64,
}

/// A section: its number, its wall, and the ends of its shortest and longest diameter (mm, LPS).
#[derive(Clone, Debug, Serialize)]
pub struct SectionMessage {
    number: usize,
    contour: Vec<Vector>,
    shortest: Option<[Vector; 2]>,
    longest: Option<[Vector; 2]>,
}

impl SectionMessage {
    /// The section of a profile that is nearest to an arc length (mm).
    pub fn nearest(profile: &Profile, at: f64) -> Self {
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
pub struct LookMessage {
    direction: Vector,
    up: Vector,
}

/// A marked stretch of a vessel.
#[derive(Clone, Debug, Serialize)]
pub struct StretchMessage {
    length: f64,
    straight: f64,
    tortuosity: f64,
    direction: Vector,
    lao: f64,
    cranial: f64,
    c_arm: String,
    view: LookMessage,
}

impl StretchMessage {
    /// The stretch between two arc lengths (mm), and the C-arm that is turned least to see it in its whole length.
    ///
    /// # Errors
    /// `measuring` for places beyond the vessel, or one place twice.
    pub fn between(profile: &Profile, ends: [f64; 2]) -> Result<Self> {
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
pub struct VesselMessage {
    /// Its id.
    pub id: String,
    /// Its name, empty where it has none.
    pub name: String,
    /// Its line.
    pub line: usize,
    /// What was marked on it.
    pub marks: MarksMessage,
}

fn arrays(points: &[DVec3]) -> Vec<Vector> {
    points.iter().map(DVec3::to_array).collect()
}
