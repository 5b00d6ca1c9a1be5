//! Rejects contours whose interior is not lumen, for example because they cross a flap or leave the lumen.

use super::SectionPlane;
use super::rays::{RAYS, Rays, direction};
use glam::DVec2;

/// Values that exceed the lumen level by this fraction of its contrast belong to another lumen.
const BRIGHTER: f64 = 0.75;

/// Maximum fraction of the enclosed area whose values do not look like lumen.
const MOST_OTHER: f64 = 0.12;

/// Points within this many blur widths of the contour are not checked: blur mixes lumen and surroundings there.
pub(crate) const BLURRED_WIDTHS: f64 = 0.75;

/// Every `CHECKED.0`-th ray is checked, at `CHECKED.1` points.
const CHECKED: (usize, usize) = (2, 6);

/// Lowest and highest value of lumen, for a `lumen` level and the level `beside` it (fractions of the contrast).
pub(crate) fn lumen_shares(lumen: f64, beside: f64) -> [f64; 2] {
    let contrast = lumen - beside;
    [beside + 0.5 * contrast, lumen + BRIGHTER * contrast]
}

/// Whether the contour encloses lumen. `walls` is its distance from `center` (mm) on each ray, and `width`
/// the blur (mm). A contour too narrow to check counts as lumen.
pub(crate) fn encloses_lumen(
    rays: &Rays,
    place: &SectionPlane,
    center: DVec2,
    walls: &[f64],
    width: f64,
    [darkest, brightest]: [f64; 2],
) -> bool {
    let (mut other, mut all) = (0.0, 0.0);
    for n in (0..RAYS).step_by(CHECKED.0) {
        let reach = walls[n] - BLURRED_WIDTHS * width;
        if reach <= 0.0 {
            continue;
        }
        for m in 0..CHECKED.1 {
            let away = reach * (m as f64 + 0.5) / CHECKED.1 as f64;
            let value = rays.at(place, center + direction(n) * away);
            // Each point stands for an area proportional to its distance from the centre.
            let area = away * reach;
            all += area;
            // NaN (outside the volume) fails both comparisons; the flag OUTSIDE reports such points.
            if value < darkest || value > brightest {
                other += area;
            }
        }
    }
    other <= MOST_OTHER * all
}

#[cfg(test)]
#[path = "tests/contour_check.rs"]
mod tests;
