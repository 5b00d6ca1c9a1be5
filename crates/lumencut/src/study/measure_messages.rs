//! Messages about measurements between page and worker. The page's types are generated from these types.

use crate::flag_table::{FLAGS, FlagLook};
use crate::measure_words::{
    of_bounds_at, of_c_arm, of_doubts, of_flags, of_flap_stretch, of_lumens_at, of_outer_at,
    of_outer_stretch, of_source, of_stenosis, of_wall,
};
use crate::narrower::narrower;
use crate::not_measured::{NotMeasured, not_measured};
use crate::not_suggested::not_suggested;
use crate::profile_json::Asked;
use crate::profile_marks::{Grade, Marked};
use glam::DVec3;
use lumencut_core::named::Named;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::stretch::{towards_detector, up_at_detector};
use lumencut_vessels::measure::stenosis::groups::Territory;
use lumencut_vessels::measure::stenosis::suggestions::Spot;
use lumencut_vessels::measure::stenosis::{Compared, Method};
use serde::{Deserialize, Serialize};

use crate::study::failure::Result;

type Vector = [f64; 3];

/// A place on a vessel (arc length, mm) and its diameter (mm).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Spot"))]
pub(crate) struct SpotMessage {
    at: f64,
    diameter: f64,
}

impl From<Spot> for SpotMessage {
    fn from(spot: Spot) -> Self {
        Self { at: spot.at, diameter: spot.diameter }
    }
}

/// The lumen of a vessel by arc length, in mm and mm²; NaN (null in JSON) if not measured.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Profile"))]
pub(crate) struct ProfileMessage {
    arc_length: Vec<f64>,
    /// Diameter of the circle of the same area (mm).
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    diameter: Vec<f64>,
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    diameter_min: Vec<f64>,
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    diameter_max: Vec<f64>,
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    area: Vec<f64>,
    /// The standard deviation of `diameter` (mm).
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    uncertainty: Vec<f64>,
    /// Whether each section is considered for the narrowest, widest and suggested places.
    counts: Vec<bool>,
    /// Words for the flags of each section, such as `calcium`, `no clear wall`.
    flags: Vec<Vec<String>>,
    /// The two bounds of each diameter next to calcium or metal, or its limit at a dim throat, in words.
    bounds: Vec<Option<String>>,
    /// All flags, in the order of plots and tables.
    flag_table: &'static [FlagLook],
    center: Vec<Vector>,
    /// FWHM of the point spread (mm).
    fwhm: f64,
    /// The source of the point-spread width: `given`, `estimated on …`, `assumed: …`.
    fwhm_source: String,
    /// The expected level of the wall, or why walls were not separated.
    wall_source: String,
    narrowest: Option<SpotMessage>,
    /// A narrower place that is not suggested, for the reason in `not_suggested`.
    passed_over: Option<SpotMessage>,
    /// The place of a throat that must be narrower than all measured places (arc length, mm), else null.
    throat: Option<f64>,
    /// The largest diameter; none if an unusual outline or a branch may be its cause.
    widest: Option<SpotMessage>,
    /// Why no narrowest place or reference is suggested, one sentence each.
    not_suggested: Vec<String>,
    not_measured: Vec<NotMeasured>,
    /// The outer wall around thrombus or plaque, in one sentence.
    outer_stretch: Option<String>,
    /// Diameter of each outer wall around thrombus or plaque, in words.
    outer: Vec<Option<String>>,
    /// The longest stretch with a flap, in one sentence.
    flap_stretch: Option<String>,
    /// Areas of the line's lumen, of the other one behind a flap, and of both, in words.
    lumens: Vec<Option<[String; 3]>>,
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
            bounds: (0..profile.len()).map(|n| of_bounds_at(profile, n)).collect(),
            flag_table: &FLAGS,
            center: arrays(&profile.center),
            fwhm: profile.fwhm,
            fwhm_source: of_source(&profile.fwhm_source),
            wall_source: of_wall(&profile.wall_source),
            narrowest: profile.narrowest().map(SpotMessage::from),
            passed_over: profile.passed_over().map(|(spot, _)| spot.into()),
            throat: profile.throat().map(|spot| spot.at),
            widest: profile.offered_widest().map(SpotMessage::from),
            not_suggested: not_suggested(profile, None, &[]),
            not_measured: not_measured(profile),
            outer_stretch: profile.outer_stretch().map(|stretch| of_outer_stretch(&stretch)),
            outer: (0..profile.len()).map(|n| of_outer_at(profile, n)).collect(),
            flap_stretch: of_flap_stretch(profile),
            lumens: (0..profile.len()).map(|n| of_lumens_at(profile, n)).collect(),
        }
    }
}

/// A reader's marks on one vessel (arc lengths, mm).
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Marks"))]
pub(crate) struct MarksMessage {
    at: Option<f64>,
    references: Vec<f64>,
    #[cfg_attr(test, ts(type = "StenosisMethod"))]
    method: String,
    /// The assumed original diameter of the vessel (mm), for ECST.
    original: Option<f64>,
    /// The diameter of a comparable normal vessel (mm).
    comparison: Option<f64>,
    #[cfg_attr(test, ts(type = "Territory | null"))]
    group: Option<String>,
    /// The ends of a stretch, for length and C-arm angles.
    stretch: Option<[f64; 2]>,
    /// The ends of a second stretch, for the angle between both stretches.
    #[serde(rename = "secondStretch")]
    second_stretch: Option<[f64; 2]>,
    #[serde(default)]
    diameters: Vec<f64>,
    /// Arc lengths of marks that confirm suggestions.
    #[serde(default)]
    confirmed: Vec<f64>,
}

impl MarksMessage {
    pub(crate) fn stretches(&self) -> Vec<[f64; 2]> {
        self.stretch.into_iter().chain(self.second_stretch).collect()
    }

    pub(crate) fn diameters(&self) -> &[f64] {
        &self.diameters
    }

    pub(crate) fn marked(&self) -> Result<Marked> {
        let method = Method::named("method of the stenosis", &self.method)?;
        let territory = self.group.as_ref().map(|name| Territory::named("vessel of the group", name));
        let compared = Compared {
            reference: self.references.clone(),
            original: self.original,
            comparison: self.comparison,
        };
        let (diameters, confirmed) = (self.diameters.clone(), self.confirmed.clone());
        Ok(Marked { at: self.at, method, compared, group: territory.transpose()?, diameters, confirmed })
    }

    /// The request with the fields of the command line; only the place if the stenosis is not graded.
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

#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Grade"))]
pub(crate) struct GradeMessage {
    stenosis: Option<StenosisMessage>,
    /// The diameter, if a place is marked, and why there is no percentage.
    not_graded: Option<String>,
    /// A place that is narrower than the marked one, in one sentence.
    narrower: Option<String>,
}

impl GradeMessage {
    pub(crate) fn of(marked: &Marked, profile: &Profile) -> Self {
        let Some(grade) = marked.grade(profile) else { return Self::default() };
        let not_graded = grade.not_graded().map(|_| grade.headline(profile));
        let narrower = grade.at().and_then(|at| narrower(profile, Some(at)));
        Self { stenosis: StenosisMessage::of(&grade), not_graded, narrower }
    }
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Stenosis"))]
struct StenosisMessage {
    /// By how much the stenosis is narrower than the reference (percent).
    percent: f64,
    /// The standard deviation of `percent`.
    #[cfg_attr(test, ts(type = "number | null"))]
    percent_uncertainty: f64,
    /// The place of the stenosis (arc length, mm).
    at: f64,
    diameter: f64,
    /// The standard deviation of `diameter` (mm).
    #[cfg_attr(test, ts(type = "number | null"))]
    uncertainty: f64,
    /// The reference value, in the method's unit.
    reference: f64,
    references: Vec<SpotMessage>,
    #[cfg_attr(test, ts(type = "StenosisMethod"))]
    method: &'static str,
    /// The percentage in one line; Python's `str(stenosis)` adds the doubts.
    words: String,
    /// Doubts about the percentage, one sentence each.
    doubts: Vec<String>,
    /// The severity group with its source, if a territory was stated and the method has groups.
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

/// A stenosis and the places to compare it with before it is graded, such as offered references (arc lengths, mm).
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Compared"))]
pub(crate) struct ComparedMessage {
    at: f64,
    references: Vec<f64>,
    #[cfg_attr(test, ts(type = "StenosisMethod"))]
    method: String,
}

impl ComparedMessage {
    pub(super) fn doubts(&self, profile: &Profile) -> Result<Vec<String>> {
        let method = Method::named("method of the stenosis", &self.method)?;
        Ok(of_doubts(&profile.doubts(self.at, method, &self.references)))
    }
}

#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Diameter"))]
pub(crate) struct DiameterMessage {
    /// Diameter of the circle of the same area (mm).
    pub diameter: f64,
    /// Standard deviation of the diameter (mm).
    #[cfg_attr(test, ts(type = "number | null"))]
    pub uncertainty: f64,
}

impl From<(f64, f64)> for DiameterMessage {
    fn from((diameter, uncertainty): (f64, f64)) -> Self {
        Self { diameter, uncertainty }
    }
}

/// A section: its number, the wall, and the ends of the shortest and longest diameter (mm, LPS).
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "MeasuredSection"))]
pub(crate) struct SectionMessage {
    number: usize,
    /// The contour of the wall; empty if none was found.
    contour: Vec<Vector>,
    /// The outer wall around thrombus or plaque; empty if it is not seen.
    outer_contour: Vec<Vector>,
    /// The lumen of the line and the other one behind a flap; empty if they are not seen.
    own_lumen: Vec<Vector>,
    other_lumen: Vec<Vector>,
    shortest: Option<[Vector; 2]>,
    longest: Option<[Vector; 2]>,
}

impl SectionMessage {
    /// The section nearest to an arc length (mm).
    pub(super) fn nearest(profile: &Profile, at: f64) -> Self {
        let number = profile.nearest_section(at);
        let middle = profile.center[number];
        let ends =
            |axis: DVec3| axis.is_finite().then(|| [middle - axis, middle + axis].map(|p| p.to_array()));
        let [shortest, longest] = profile.half_axes[number].map(ends);
        Self {
            number,
            contour: arrays(&profile.contour[number]),
            outer_contour: arrays(&profile.outer_contour[number]),
            own_lumen: arrays(&profile.own_lumen[number]),
            other_lumen: arrays(&profile.other_lumen[number]),
            shortest,
            longest,
        }
    }
}

#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Look"))]
pub(crate) struct LookMessage {
    direction: Vector,
    up: Vector,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Stretch"))]
pub(crate) struct StretchMessage {
    /// Length along the vessel (mm).
    length: f64,
    /// Straight distance between the ends (mm).
    straight: f64,
    /// `length` / `straight`; null for a closed stretch.
    #[cfg_attr(test, ts(type = "number | null"))]
    tortuosity: f64,
    direction: Vector,
    /// LAO angle of a C-arm that shows the stretch without foreshortening (radians).
    lao: f64,
    /// Cranial angle of that C-arm (radians).
    cranial: f64,
    /// The angles as displayed on a C-arm: `RAO 20° CRAN 5°`.
    c_arm: String,
    view: LookMessage,
}

impl StretchMessage {
    /// The stretch between two arc lengths (mm), and the least-angled C-arm that shows it without foreshortening.
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

#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "MeasuredVessel"))]
pub(crate) struct VesselMessage {
    pub(crate) id: String,
    /// Name; may be empty.
    pub name: String,
    pub line: usize,
    pub(crate) marks: MarksMessage,
}

fn arrays(points: &[DVec3]) -> Vec<Vector> {
    points.iter().map(DVec3::to_array).collect()
}
