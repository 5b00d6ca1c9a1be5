//! Decides which pictures a report needs from its caller.

use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

use super::frame::{StripLayout, axis_along};
use super::places::{ReportMark, ReportPlace, places};
use super::plot::{STRIP, WIDTH};
use super::section_room::{section_side, section_spacing};

const PIXELS_PER_PLOT_PIXEL: f64 = 1.6;

/// The pictures of a vessel.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "ReportPlan"))]
pub struct Plan {
    /// The width of the straightened vessel (mm); the picture is narrower if the volume is.
    pub width: f64,
    /// Pixel side of the straightened vessel (mm).
    pub spacing: f64,
    /// The places of the section pictures, in order.
    pub places: Vec<ReportPlace>,
    /// Pixel side of the section pictures (mm).
    pub section_spacing: f64,
}

/// Plans the pictures of a vessel with these marks; section pictures have this many pixels on each side.
pub fn plan(profile: &Profile, marks: &[ReportMark], section_pixels: usize) -> Plan {
    let x = axis_along(profile.length(), WIDTH);
    let strip = StripLayout::along(&x, STRIP, PIXELS_PER_PLOT_PIXEL, section_side(profile));
    Plan {
        width: strip.width,
        spacing: strip.spacing,
        places: places(marks),
        section_spacing: section_spacing(profile, section_pixels),
    }
}
