//! Finds what lies behind the wall and is clearly brighter than a wall, such as a vein. Blur can fill the valley between
//! it and the lumen, so that values do not rise again.

use glam::DVec2;

use crate::measure::section::SectionPlane;
use crate::measure::section::rays::{RAYS, Rays, direction};

/// Values are read from this many blur widths outside of the lumen, where blur leaves little of it, and this far (mm).
const BEHIND: (f64, f64) = (0.9, 1.0);

/// Brighter values are not tissue: 0 is the level of a wall, 1 that of the lumen.
const BRIGHT: f64 = 0.25;

/// One of this number of rays is read, and at least this number of them must be bright.
const EVERY: usize = 2;
const LEAST_RAYS: usize = 3;

/// Whether something bright lies behind the wall. `walls` gives the measured radius on each ray, `levels` those of lumen
/// and wall, and `width` the blur (mm).
pub(crate) fn is_bright_behind(
    rays: &Rays,
    (place, center): (&SectionPlane, DVec2),
    walls: &[f64],
    [lumen, wall]: [f64; 2],
    width: f64,
) -> bool {
    let step = rays.step();
    let count = (BEHIND.1 / step).ceil().max(1.0) as usize;
    let limit = wall + BRIGHT * (lumen - wall);
    let is_bright = |n: &usize| {
        let value = |m: usize| {
            rays.at(place, center + direction(*n) * (walls[*n] + BEHIND.0 * width + m as f64 * step))
        };
        (0..=count).map(value).sum::<f64>() > limit * (count + 1) as f64
    };
    (0..RAYS).step_by(EVERY).filter(is_bright).count() >= LEAST_RAYS
}
