//! Finds plaque that is nearly as bright as the lumen: values stay between those of lumen and wall for longer than
//! blur explains. Where such plaque ends and the lumen begins is hard to see.

use glam::DVec2;

use crate::measure::section::SectionPlane;
use crate::measure::section::rays::{RAYS, Rays, direction};
use lumencut_core::math::statistics::median;

/// Range of the values of such plaque: 0 is the level of a wall, 1 that of the lumen.
const PLATEAU: [f64; 2] = [0.2, 0.6];

/// A plateau is longer than this many blur widths; an edge between lumen and wall takes half of one.
const WIDTHS: f64 = 0.9;

/// Every how many rays are read, and how many of them must cross a plateau.
const EVERY: usize = 2;
const LEAST_RAYS: usize = 5;

/// Rays are read up to this multiple of the radius, plus this many mm.
const REACH: (f64, f64) = (1.6, 2.0);

/// Factor of the diameter without the plaque; None without such plaque. `walls` gives the measured radius on each ray,
/// `levels` those of lumen and wall, and `width` the blur (mm).
pub(crate) fn narrowed(
    rays: &Rays,
    (place, center): (&SectionPlane, DVec2),
    walls: &[f64],
    [lumen, wall]: [f64; 2],
    width: f64,
) -> Option<f64> {
    let step = rays.step();
    let read = |n: &usize| -> Vec<f64> {
        let count = ((REACH.0 * walls[*n] + REACH.1) / step) as usize;
        let value = |m: usize| rays.at(place, center + direction(*n) * (m as f64 * step));
        (0..count).map(|m| (value(m) - wall) / (lumen - wall)).collect()
    };
    let numbers: Vec<usize> = (0..RAYS).step_by(EVERY).collect();
    let shares: Vec<Vec<f64>> = numbers.iter().map(read).collect();
    let plateaus: Vec<Option<f64>> =
        shares.iter().map(|shares| plateau(shares, WIDTHS * width / step)).collect();
    if plateaus.iter().flatten().count() < LEAST_RAYS {
        return None;
    }
    let level = median(&mut plateaus.iter().copied().flatten().collect::<Vec<f64>>())?;
    let measured: Vec<f64> = numbers.iter().map(|n| walls[*n]).collect();
    let inner = |n: usize| {
        let edge = shares[n].iter().position(|share| *share < f64::midpoint(1.0, level));
        let edge = edge.filter(|_| plateaus[n].is_some()).map(|m| (m as f64 - 0.5).max(0.0) * step);
        edge.unwrap_or(f64::INFINITY).min(measured[n])
    };
    let inner: Vec<f64> = (0..measured.len()).map(inner).collect();
    Some((area(&inner) / area(&measured)).sqrt())
}

/// Median value of a ray's plateau; None if the values fall through its range within `width` samples.
fn plateau(shares: &[f64], width: f64) -> Option<f64> {
    let [low, high] = PLATEAU;
    let begins = shares.iter().position(|share| *share < high)?;
    let length = shares[begins..].iter().position(|share| *share < low)?;
    (length as f64 > width).then(|| median(&mut shares[begins..begins + length].to_vec()))?
}

/// Proportional to the area of the polygon with corners at these distances, in evenly spaced directions.
fn area(radii: &[f64]) -> f64 {
    (0..radii.len()).map(|n| radii[n] * radii[(n + 1) % radii.len()]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plateau_is_longer_than_the_blur() {
        let edge = [1.0, 0.95, 0.7, 0.5, 0.3, 0.1, -0.4];
        let plaque = [1.0, 0.95, 0.7, 0.45, 0.4, 0.4, 0.4, 0.4, 0.3, 0.1, -0.4];
        let organ = [1.0, 0.95, 0.7, 0.4, 0.4, 0.4, 0.4, 0.4, 0.4];
        assert_eq!(plateau(&edge, 4.0), None);
        assert_eq!(plateau(&plaque, 4.0), Some(0.4));
        assert_eq!(plateau(&organ, 4.0), None, "what does not end is no plaque");
    }
}
