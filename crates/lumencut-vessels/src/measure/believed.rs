//! Whether what lies within a contour is lumen: else it crosses a flap, or runs into another lumen or out of its own.

use super::place::Place;
use super::rays::{RAYS, Rays, direction};
use glam::DVec2;

/// What is brighter than lumen by this share of its contrast is another lumen.
const BRIGHTER: f64 = 0.75;

/// A contour is not believed where more than this share of what it encloses is no lumen.
const MOST_OTHER: f64 = 0.12;

/// How far within the contour the blur still mixes lumen with what is beside it, in widths of the blur.
const MIXED: f64 = 0.75;

/// Every so many rays are looked along, at so many places each.
const LOOKED: (usize, usize) = (2, 6);

/// The shares that a lumen of a level has, where what is beside it has another one.
pub fn lumen_shares(lumen: f64, beside: f64) -> [f64; 2] {
    let contrast = lumen - beside;
    [beside + 0.5 * contrast, lumen + BRIGHTER * contrast]
}

/// Whether a contour encloses what has the shares of lumen: walls so far from a centre along the rays (mm), under a blur of this
/// width (mm). Places that the blur mixes with what is beside the lumen tell nothing, and a lumen without others is believed.
pub fn encloses_lumen(
    rays: &Rays,
    place: &Place,
    center: DVec2,
    walls: &[f64],
    width: f64,
    [darkest, brightest]: [f64; 2],
) -> bool {
    let (mut other, mut all) = (0.0, 0.0);
    for n in (0..RAYS).step_by(LOOKED.0) {
        let reach = walls[n] - MIXED * width;
        if reach <= 0.0 {
            continue;
        }
        for m in 0..LOOKED.1 {
            let away = reach * (m as f64 + 0.5) / LOOKED.1 as f64;
            let value = rays.at(place, center + direction(n) * away);
            // Far from the centre each place stands for a larger area.
            let area = away * reach;
            all += area;
            // What lies outside of the volume has a flag of its own.
            if value < darkest || value > brightest {
                other += area;
            }
        }
    }
    other <= MOST_OTHER * all
}

#[cfg(test)]
#[path = "tests/believed.rs"]
mod tests;
