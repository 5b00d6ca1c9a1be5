//! The pictures of a vessel that a report asks its host for.

use lumencut_core::math::statistics::quantile;
use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

use super::places::{Place, ReportMark, places};
use super::plot::{STRIP, axis_along};

/// A picture of a section is this many times as wide as the lumen, and within these sides (mm); this wide where nothing is known.
const ROOM: f64 = 2.5;
const SIDES: [f64; 2] = [12.0, 120.0];
const UNKNOWN: f64 = 30.0;

/// This share of the sections that count has room in the pictures.
const FITTING: f64 = 0.9;

/// Of a short vessel less of its surroundings is shown, so that it is not drawn flat, but at least this share of the side of
/// the pictures of sections; and the narrowest and the widest strip (mm).
const LEAST: f64 = 0.6;
const WIDTHS: [f64; 2] = [12.0, 90.0];

/// Pixels of the straightened vessel in one of the plot, and the finest one (mm).
const DENSITY: f64 = 1.6;
const FINEST: f64 = 0.05;

/// The pictures of a vessel.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportPlan"))]
pub struct Plan {
    /// The width of the straightened vessel across it (mm); a host shows less where the volume has less.
    pub width: f64,
    /// The side of its pixels (mm).
    pub spacing: f64,
    /// The places whose sections are shown, in this order.
    pub places: Vec<Place>,
    /// The side of the pictures of sections (mm).
    pub side: f64,
}

/// What a report of a vessel with these places shows.
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

/// The side of pictures in which nearly all sections that count have room (mm).
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
