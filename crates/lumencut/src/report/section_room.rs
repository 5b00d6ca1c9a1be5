//! The size of section pictures.

use lumencut_core::math::statistics::quantile;
use lumencut_vessels::measure::profile::Profile;

use super::chart::longest_diameters;

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

/// The side of section pictures (mm) in which nearly all reliable sections fit.
pub(crate) fn section_side(profile: &Profile) -> f64 {
    let mut diameters = longest_diameters(profile);
    let fitting = quantile(&mut diameters, FITTING_QUANTILE).map(|wide| (SECTION_DIAMETERS * wide).ceil());
    fitting.map_or(DEFAULT_SIDE_MM, |side| side.clamp(SECTION_SIDES_MM[0], SECTION_SIDES_MM[1]))
}

/// The pixel side (mm) of section pictures with this many pixels on each side; the outer pixel centres are `section_side` apart.
pub fn section_spacing(profile: &Profile, pixels: usize) -> f64 {
    section_side(profile) / pixels.saturating_sub(1).max(1) as f64
}

#[cfg(test)]
#[path = "../tests/report_section_room.rs"]
mod tests;
