//! Decides which pictures a report needs from its caller.

use lumencut_core::math::statistics::quantile;
use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

use super::places::{ReportMark, ReportPlace, places};
use super::plot::{STRIP, axis_along};

/// Side of a section picture: this many lumen diameters, within these bounds (mm); the default if no diameter was measured.
const SECTION_DIAMETERS: f64 = 2.5;
const SECTION_SIDES_MM: [f64; 2] = [12.0, 120.0];
const DEFAULT_SIDE_MM: f64 = 30.0;

/// At least this fraction of the sections fits into the section pictures.
const FITTING_QUANTILE: f64 = 0.9;

/// A short vessel gets a narrower strip, which fits the height of the plot. Its width is at least this fraction of a section
/// picture, and within these bounds (mm).
const MIN_STRIP_RATIO: f64 = 0.6;
const STRIP_WIDTHS_MM: [f64; 2] = [12.0, 90.0];

/// Pixels of the strip per plot pixel, and the smallest pixel side (mm).
const PIXELS_PER_PLOT_PIXEL: f64 = 1.6;
const MIN_PIXEL_MM: f64 = 0.05;

/// The pictures of a vessel.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportPlan"))]
pub struct Plan {
    /// The width of the straightened vessel (mm). It is shown narrower if the volume is narrower.
    pub width: f64,
    /// Pixel side of the straightened vessel (mm).
    pub spacing: f64,
    /// The places of the section pictures, in order.
    pub places: Vec<ReportPlace>,
    /// The side of the section pictures (mm).
    pub side: f64,
}

/// Plans the pictures of a vessel with these marks.
pub fn plan(profile: &Profile, marks: &[ReportMark]) -> Plan {
    let x = axis_along(profile.length());
    let pixel = profile.length() / (x.end - x.start);
    let side = fitting_side(profile);
    let wished = (STRIP * pixel).min(side).max(MIN_STRIP_RATIO * side);
    Plan {
        width: wished.clamp(STRIP_WIDTHS_MM[0], STRIP_WIDTHS_MM[1]),
        spacing: (pixel / PIXELS_PER_PLOT_PIXEL).max(MIN_PIXEL_MM),
        places: places(marks),
        side,
    }
}

/// The side of pictures (mm) in which nearly all reliable sections fit.
fn fitting_side(profile: &Profile) -> f64 {
    let wide = |is_among: &dyn Fn(usize) -> bool| -> Vec<f64> {
        let among = (0..profile.len()).filter(|n| is_among(*n)).map(|n| profile.diameter_max[n]);
        among.filter(|value| value.is_finite()).collect()
    };
    let mut diameters = wide(&|n| profile.counts(n));
    if diameters.is_empty() {
        diameters = wide(&|_| true);
    }
    let fitting = quantile(&mut diameters, FITTING_QUANTILE).map(|wide| (SECTION_DIAMETERS * wide).ceil());
    fitting.map_or(DEFAULT_SIDE_MM, |side| side.clamp(SECTION_SIDES_MM[0], SECTION_SIDES_MM[1]))
}
