//! The intensity scale of a vessel: the levels of its lumen and of its surroundings.

use glam::DVec2;

use super::SectionPlane;
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::statistics::median;

const DIRECTIONS: usize = 16;

const MOST_PLACES: usize = 150;

/// A distance counts if at least this fraction of its points lies within the volume: its corners alone may hold bone.
const LEAST_INSIDE: f64 = 1.0 / 3.0;

/// Search radius (mm) for a vessel whose radius is unknown.
const SEARCH_RADIUS_MM: f64 = 30.0;

/// From inside, the wall is the first slope that has at least this fraction of the steepest slope.
const STEEP: f64 = 0.4;

/// The surroundings are searched up to this distance beyond the wall (mm).
const BEYOND: f64 = 1.5;

/// Maximum width of a bright rim (mm); minimum fall behind it, as a fraction of the rim's excess over lumen.
const MAX_RIM_MM: f64 = 4.0;
const RIM_SHARE: f64 = 0.1;

/// Maps values of a volume to fractions of the contrast: 0 is the level outside the vessel, 1 that of its lumen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// Intensity level outside the vessel.
    pub outside: f64,
    /// Intensity level of the lumen minus that outside; negative for lumens darker than their surroundings.
    pub contrast: f64,
}

impl Scale {
    pub(crate) fn share(&self, value: f64) -> f64 {
        (value - self.outside) / self.contrast
    }

    pub(crate) fn value(&self, share: f64) -> f64 {
        self.outside + share * self.contrast
    }

    /// Finds the scale from the median values at each distance from the vessel; `radius` (mm) is approximate.
    pub(crate) fn of(voxels: &Voxels, places: &[SectionPlane], radius: Option<f64>) -> Result<Self> {
        let step = 0.5 * voxels.sampling_side;
        let reach = radius.map_or(SEARCH_RADIUS_MM, |radius| 2.5 * radius + 3.0);
        let rings = rings(voxels, places, step, (reach / step).ceil() as usize);
        let [Some(lumen), ..] = rings[..] else {
            let expected = "a vessel within the volume";
            return Err(Error::new(
                ErrorKind::Measuring,
                "points of the vessel",
                "none within the volume",
                expected,
            ));
        };
        let rings: Vec<f64> = rings.into_iter().flatten().collect();
        // Each slope spans two sampling steps, which is one voxel.
        let slopes: Vec<f64> = rings.windows(3).map(|three| three[2] - three[0]).collect();
        let steepest = slopes.iter().map(|slope| slope.abs()).fold(0.0, f64::max);
        let none = || {
            let found = format!("{} both on the vessel and around it", in_words(lumen));
            let expected = "a lumen that is brighter or darker than its surroundings";
            Error::new(ErrorKind::Measuring, "lumen of the vessel", found, expected)
        };
        let mut wall = slopes.iter().position(|slope| slope.abs() >= STEEP * steepest).ok_or_else(none)?;
        while wall + 1 < slopes.len() && slopes[wall + 1].abs() > slopes[wall].abs() {
            wall += 1;
        }
        let within = |mm: f64| wall + 1..rings.len().min(wall + 2 + (mm / step).ceil() as usize);
        let lowest = |mm: f64| rings[within(mm)].iter().copied().fold(f64::MAX, f64::min);
        let highest = rings[within(BEYOND)].iter().copied().fold(f64::MIN, f64::max);
        // A bright ring with darker values behind it is a rim, such as a stent.
        let is_rim = slopes[wall] > 0.0 && lowest(MAX_RIM_MM) < lumen - RIM_SHARE * (highest - lumen);
        let outside = if slopes[wall] < 0.0 {
            lowest(BEYOND)
        } else if is_rim {
            lowest(MAX_RIM_MM)
        } else {
            highest
        };
        let contrast = lumen - outside;
        let is_one =
            contrast.abs() >= scatter(voxels, places, lumen) && (is_rim || contrast * slopes[wall] < 0.0);
        if is_one { Ok(Self { outside, contrast }) } else { Err(none()) }
    }
}

pub(crate) fn in_words(value: f64) -> String {
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 6.0);
    format!("{value:.*}", if value == 0.0 { 0 } else { decimals as usize })
}

fn scatter(voxels: &Voxels, places: &[SectionPlane], lumen: f64) -> f64 {
    let values = places.iter().map(|place| f64::from(voxels.at(place.origin)));
    let mut off: Vec<f64> = values.filter(|value| value.is_finite()).map(|v| (v - lumen).abs()).collect();
    1.4826 * median(&mut off).unwrap_or(f64::INFINITY)
}

/// Median value at each distance from the vessel, over all sections and directions.
fn rings(voxels: &Voxels, places: &[SectionPlane], step: f64, count: usize) -> Vec<Option<f64>> {
    let every = places.len().div_ceil(MOST_PLACES);
    let all = DIRECTIONS * places.len().div_ceil(every);
    (0..=count)
        .map(|n| {
            let mut values = Vec::new();
            for place in places.iter().step_by(every) {
                for direction in 0..DIRECTIONS {
                    let angle = std::f64::consts::TAU * direction as f64 / DIRECTIONS as f64;
                    let value = voxels.at(place.point(DVec2::from_angle(angle) * (n as f64 * step)));
                    if value.is_finite() {
                        values.push(f64::from(value));
                    }
                }
            }
            median(&mut values).filter(|_| values.len() as f64 >= LEAST_INSIDE * all as f64)
        })
        .collect()
}
