//! Decides which pictures a report needs from its caller, and the size of its section pictures.

use std::f64::consts::PI;

use lumencut_vessels::measure::profile::Profile;
use serde::Serialize;

use super::chart::longest_diameters;
use super::frame::{StripLayout, axis_along};
use super::places::{ReportMark, ReportPlace, places};
use super::plot::{STRIP, WIDTH};
use lumencut_core::math::statistics::quantile;

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

/// The side of a section picture: a multiple of the lumen diameter, within bounds (mm), or a default without diameters.
const SECTION_DIAMETERS: f64 = 2.5;
const SECTION_SIDES_MM: [f64; 2] = [12.0, 120.0];
pub(crate) const DEFAULT_SIDE_MM: f64 = 30.0;

/// At least this fraction of the sections fits in pictures of the chosen size.
const FITTING_QUANTILE: f64 = 0.9;

/// Side of section pictures in reports of the command line (pixels).
pub const REPORT_PIXELS: usize = 200;
/// Side of section pictures on sheets of the command line (pixels).
pub const SHEET_PIXELS: usize = 260;
/// Side of section pictures in reports of the page (pixels).
pub(crate) const PAGE_PIXELS: usize = 300;

/// The side of a section picture as a multiple of the diameter of the outer wall, which may be much wider than the lumen.
const OUTER_DIAMETERS: f64 = 1.2;

/// The same for both lumens of a dissected vessel, of which one may lie aside.
const LUMENS_DIAMETERS: f64 = 2.0;

fn of_both(profile: &Profile, n: usize) -> f64 {
    2.0 * (profile.area_both_lumens()[n][0] / PI).sqrt()
}

/// The side of section pictures (mm) in which nearly all reliable sections fit.
pub(crate) fn section_side(profile: &Profile) -> f64 {
    let mut diameters = longest_diameters(profile);
    let both =
        profile.flap_stretch().map_or(0.0, |stretch| LUMENS_DIAMETERS * of_both(profile, stretch.widest));
    let outer = profile.outer_stretch().map_or(0.0, |stretch| OUTER_DIAMETERS * stretch.widest[1]);
    let fitting = quantile(&mut diameters, FITTING_QUANTILE)
        .map(|wide| (SECTION_DIAMETERS * wide).max(outer).max(both).ceil());
    fitting.map_or(DEFAULT_SIDE_MM, |side| side.clamp(SECTION_SIDES_MM[0], SECTION_SIDES_MM[1]))
}

/// The pixel side (mm) of section pictures with this many pixels on each side; the outer pixel centres are `section_side` apart.
pub fn section_spacing(profile: &Profile, pixels: usize) -> f64 {
    section_side(profile) / pixels.saturating_sub(1).max(1) as f64
}

#[cfg(test)]
#[path = "../tests/report_pictures.rs"]
mod tests;
