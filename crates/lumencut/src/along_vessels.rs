//! Values along the vessels of a tree, as colours of a rim or of a map, with their legend.

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::arc_length::LinePlace;
use lumencut_core::settings::RimValue;
use lumencut_core::stages::rim::RimColors;
use lumencut_core::vessel_tree::Vessel;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::stenosis::Stenosis;

use crate::narrowing::{deviations, measured, narrowings};
use crate::value_colours::{Colours, coloured, scale_end};

/// Largest distance between values along a vessel (mm), and their largest number.
const STEP: f64 = 0.25;
const MOST: usize = 1 << 16;
/// Multiple to which the ends of a scale of lengths (mm) and of percentages are rounded.
const LENGTH_STEP: f64 = 0.5;
const PERCENT_STEP: f64 = 10.0;

/// A vessel with what was measured on it.
#[derive(Clone, Copy)]
pub struct Along<'a> {
    /// Its centerline.
    pub vessel: &'a Vessel,
    /// Its profile, if it was measured.
    pub profile: Option<&'a Profile>,
    /// The graded stenoses of the profile.
    pub stenoses: &'a [Stenosis],
}

/// What the colours mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Legend {
    /// The quantity in words.
    pub words: &'static str,
    /// The unit of the values.
    pub unit: &'static str,
    /// The values of the first and of the last colour.
    pub ends: [f64; 2],
    /// The colour map.
    pub colours: Colours,
}

/// Values along the vessels of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct ValuesAlong {
    /// Values of each vessel at equal steps of arc length from its start to its end, NaN where unknown.
    pub values: Vec<Vec<f32>>,
    /// What the colours mean.
    pub legend: Legend,
    /// Radii at the same places (mm), NaN where unknown.
    radii: Vec<Vec<f32>>,
    lengths: Vec<f64>,
    has_radius: Vec<bool>,
}

impl ValuesAlong {
    /// The values of `kind` of each vessel. Fails with [`ErrorKind::Measuring`] if no vessel has any.
    pub fn new(kind: RimValue, vessels: &[Along]) -> Result<Self> {
        let values: Vec<Vec<f32>> = vessels.iter().map(|along| along.values(kind)).collect();
        let known: Vec<f32> = values.iter().flatten().copied().filter(|value| value.is_finite()).collect();
        if known.is_empty() {
            return Err(without_values(kind));
        }
        let has_radius = vessels.iter().map(|along| along.vessel.radius().is_some()).collect();
        Ok(Self {
            values,
            legend: Legend::of(kind, &known),
            radii: vessels.iter().map(Along::radii).collect(),
            lengths: vessels.iter().map(Along::length).collect(),
            has_radius,
        })
    }

    /// The values with the ends of the colours that these settings choose. Fails with [`ErrorKind::Settings`] if the lower
    /// end is not below the upper one.
    pub fn ranged(mut self, [low, high]: [Option<f64>; 2]) -> Result<Self> {
        let Legend { ends, unit, .. } = &mut self.legend;
        *ends = [low.unwrap_or(ends[0]), high.unwrap_or(ends[1])];
        if ends[0] < ends[1] {
            return Ok(self);
        }
        let found = format!("{} to {} {unit}", ends[0], ends[1]);
        Err(Error::new(ErrorKind::Settings, "colours of the rim", found, "rim_low below rim_high")
            .mend("set both rim_low and rim_high, or neither"))
    }

    /// The colours of each vessel's values.
    pub fn colours(&self) -> Vec<Vec<[u8; 4]>> {
        let Legend { ends, colours, .. } = self.legend;
        self.values.iter().map(|values| coloured(values, ends, colours)).collect()
    }

    /// The index of the value nearest to an arc length (mm) of a vessel, if it has values.
    pub(crate) fn place(&self, vessel: usize, at: f64) -> Option<usize> {
        index(at, self.lengths[vessel], self.values[vessel].len())
    }

    /// The radius at an arc length (mm), 0 where it is unknown.
    pub(crate) fn radius(&self, vessel: usize, at: f64) -> f64 {
        let radii = &self.radii[vessel];
        let found = index(at, self.lengths[vessel], radii.len()).map_or(f32::NAN, |n| radii[n]);
        f64::from(found.max(0.0))
    }

    /// The colours of a rim. Fails with [`ErrorKind::VesselTree`] if no vessel with values has radii, at which the rim lies.
    pub fn rim(&self) -> Result<RimColors> {
        let mut colours = self.colours();
        for (colours, _) in colours.iter_mut().zip(&self.has_radius).filter(|(_, has_radius)| !**has_radius) {
            colours.clear();
        }
        if colours.iter().flatten().any(|[.., alpha]| *alpha > 0) {
            return Ok(RimColors::new(&colours));
        }
        let found = "vessels without radii";
        Err(Error::new(ErrorKind::VesselTree, "rim", found, "radii, which state where the wall is")
            .mend("measure the radii of the tree, or leave the rim out"))
    }
}

impl Legend {
    fn of(kind: RimValue, known: &[f32]) -> Self {
        let least = f64::from(known.iter().copied().fold(f32::INFINITY, f32::min));
        let most = f64::from(known.iter().copied().fold(f32::NEG_INFINITY, f32::max));
        let up = |value: f64, step: f64| (value / step).ceil().max(1.0) * step;
        let (words, unit, ends, colours) = match kind {
            RimValue::Diameter => {
                let low = (least / LENGTH_STEP).floor() * LENGTH_STEP;
                ("diameter", "mm", [low, low + up(most - low, LENGTH_STEP)], Colours::Sea)
            }
            RimValue::Narrowing => ("narrowing", "%", [0.0, up(most, PERCENT_STEP)], Colours::Sea),
            RimValue::Deviation => {
                let end = up(most.max(-least), LENGTH_STEP);
                ("deviation from the reference", "mm", [-end, end], Colours::BlueRed)
            }
            RimValue::Uncertainty => {
                ("uncertainty of the diameter (1 SD)", "mm", [0.0, scale_end(known)], Colours::Sea)
            }
        };
        Self { words, unit, ends, colours }
    }
}

impl Along<'_> {
    fn values(&self, kind: RimValue) -> Vec<f32> {
        let places = places(self.length());
        let values = match (kind, self.profile) {
            (RimValue::Diameter, None) => places.iter().map(|at| self.diameter_of_radius(*at)).collect(),
            (RimValue::Diameter, Some(profile)) => {
                places.iter().map(|at| measured(profile, *at)[0]).collect()
            }
            (RimValue::Uncertainty, Some(profile)) => {
                places.iter().map(|at| measured(profile, *at)[1]).collect()
            }
            (RimValue::Narrowing, Some(profile)) => narrowings(profile, self.stenoses, &places),
            (RimValue::Deviation, Some(profile)) => deviations(profile, self.stenoses, &places),
            (RimValue::Uncertainty | RimValue::Narrowing | RimValue::Deviation, None) => Vec::new(),
        };
        values.into_iter().map(|value: f64| value as f32).collect()
    }

    fn radii(&self) -> Vec<f32> {
        self.values(RimValue::Diameter).iter().map(|diameter| diameter / 2.0).collect()
    }

    fn length(&self) -> f64 {
        self.vessel.arc_length().last().copied().unwrap_or_default()
    }

    fn diameter_of_radius(&self, at: f64) -> f64 {
        let Some(radius) = self.vessel.radius() else { return f64::NAN };
        let known = LinePlace::at(self.vessel.arc_length(), at).value(radius);
        if known > 0.0 { 2.0 * known } else { f64::NAN }
    }
}

fn index(at: f64, length: f64, count: usize) -> Option<usize> {
    let last = count.checked_sub(1)?;
    let share = if length > 0.0 { (at / length).clamp(0.0, 1.0) } else { 0.0 };
    Some((share * last as f64).round() as usize)
}

/// Equal steps from 0 to a length (mm).
fn places(length: f64) -> Vec<f64> {
    let steps = ((length / STEP).ceil().max(1.0) as usize).min(MOST - 1);
    (0..=steps).map(|n| length * n as f64 / steps as f64).collect()
}

fn without_values(kind: RimValue) -> Error {
    let (found, expected, mend) = match kind {
        RimValue::Diameter => (
            "neither radii nor profiles",
            "radii or profiles",
            "measure the vessels, and give their profiles",
        ),
        RimValue::Narrowing | RimValue::Deviation => (
            "no graded stenosis",
            "profiles with a graded stenosis",
            "grade a stenosis, and give it with its profile; or show the diameter",
        ),
        RimValue::Uncertainty => {
            ("no measured diameter", "profiles", "measure the vessels, and give their profiles")
        }
    };
    Error::new(ErrorKind::Measuring, "values along the vessels", found, expected).mend(mend)
}

/// Largest difference between the lengths of a vessel and of its profile (mm).
const LENGTH_SLACK: f64 = 1.0;
/// Smallest limit for the median distance between the middles of a profile and its vessel (mm).
const NEAR: f64 = 2.0;

/// The vessel on which a profile was measured. Fails with [`ErrorKind::Measuring`] if there is none.
pub fn vessel_of(profile: &Profile, vessels: &[Vessel]) -> Result<usize> {
    let length = profile.arc_length[profile.len() - 1];
    let ends_alike =
        |vessel: &Vessel| vessel.arc_length().last().is_some_and(|end| (end - length).abs() <= LENGTH_SLACK);
    let apart = |vessel: &Vessel| {
        let point = |at: f64| LinePlace::at(vessel.arc_length(), at).point(vessel.points());
        let sections = profile.arc_length.iter().zip(&profile.center);
        middle(sections.map(|(at, center)| point(*at).distance(*center)).collect())
    };
    let radius = middle(profile.diameter_equivalent().iter().map(|diameter| diameter / 2.0).collect());
    let limit = radius.max(NEAR);
    let near = vessels.iter().enumerate().filter(|(_, vessel)| ends_alike(vessel));
    let near = near.map(|(n, vessel)| (n, apart(vessel))).filter(|(_, apart)| *apart <= limit);
    near.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(n, _)| n).ok_or_else(|| {
        let found = format!("one of {length:.1} mm that follows no vessel of the tree");
        Error::new(ErrorKind::Measuring, "profiles", found, "profiles of vessels of this tree")
            .mend("measure the vessels of the tree that is shown")
    })
}

/// The median of the finite numbers; 0 without any.
fn middle(mut numbers: Vec<f64>) -> f64 {
    numbers.retain(|number| number.is_finite());
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or_default()
}

#[cfg(test)]
#[path = "tests/along_vessels.rs"]
mod tests;
