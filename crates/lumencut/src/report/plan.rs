//! The pictures that a report requests from its host.

use lumencut_core::math::statistics::quantile;
use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

use super::places::{Place, ReportMark, places};
use super::plot::{STRIP, axis_along};

/// The side of a section picture: this many lumen diameters, within these bounds (mm), or this default.
const ROOM: f64 = 2.5;
const SIDES: [f64; 2] = [12.0, 120.0];
const UNKNOWN: f64 = 30.0;

/// The quantile of sections that fit the pictures.
const FITTING: f64 = 0.9;

/// The strip of a short vessel is narrower, so that it is not flat, but at least this fraction of the section pictures; and its
/// bounds (mm).
const LEAST: f64 = 0.6;
const WIDTHS: [f64; 2] = [12.0, 90.0];

/// Pixels of the strip per plot pixel, and the finest pixel side (mm).
const DENSITY: f64 = 1.6;
const FINEST: f64 = 0.05;

/// The pictures of a vessel.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportPlan"))]
pub struct Plan {
    /// The width of the straightened vessel (mm); a host shows less if the volume has less.
    pub width: f64,
    /// Its pixel side (mm).
    pub spacing: f64,
    /// The places of the section pictures, in order.
    pub places: Vec<Place>,
    /// The side of the section pictures (mm).
    pub side: f64,
}

/// The pictures for a vessel with these marks.
pub fn plan(profile: &Profile, marks: &[ReportMark]) -> Plan {
    let x = axis_along(profile.length());
    let pixel = profile.length() / (x.end - x.start);
    let side = fitting_side(profile);
    let wished = (STRIP * pixel).min(side).max(LEAST * side);
    Plan {
        width: wished.clamp(WIDTHS[0], WIDTHS[1]),
        spacing: (pixel / DENSITY).max(FINEST),
        places: places(marks),
        side,
    }
}

/// The side that fits nearly all counting sections (mm).
fn fitting_side(profile: &Profile) -> f64 {
    let wide = |is_among: &dyn Fn(usize) -> bool| -> Vec<f64> {
        let among = (0..profile.len()).filter(|n| is_among(*n)).map(|n| profile.diameter_max[n]);
        among.filter(|value| value.is_finite()).collect()
    };
    let mut diameters = wide(&|n| profile.counts(n));
    if diameters.is_empty() {
        diameters = wide(&|_| true);
    }
    let fitting = quantile(&mut diameters, FITTING).map(|wide| (ROOM * wide).ceil());
    fitting.map_or(UNKNOWN, |side| side.clamp(SIDES[0], SIDES[1]))
}
