//! Computes bounds of a diameter next to calcium or metal. Both look larger than they are and hide the wall.

use std::f64::consts::TAU;

use super::is_bright;
use crate::measure::section::rays::{RAYS, Ray};

/// Calcium hides at least this many rays in a row; the struts of a stent hide fewer.
const WIDE: usize = RAYS / 8;

/// Bounds of the diameter as factors of the measured one: without, and with, all bright material at the wall.
/// `wall` gives the measured radius (mm) on each ray.
pub(crate) fn bounds(rays: &[Ray], wall: impl Fn(usize) -> f64, width: f64) -> [f64; 2] {
    // Bright material beyond a visible edge of the lumen does not hide that edge.
    let hides = |n: usize| rays[n].edge.is_none() && is_bright(&rays[n], wall(n), width);
    let measured: Vec<f64> = (0..RAYS).map(&wall).collect();
    let bound = |n: usize, other: f64| if hides(n) { other } else { measured[n] };
    let mut inner: Vec<f64> = (0..RAYS).map(|n| bound(n, rays[n].rim[0].min(measured[n]))).collect();
    narrow_beside(&mut inner, &measured, hides, width);
    let outer: Vec<f64> = (0..RAYS).map(|n| bound(n, rays[n].rim[1].max(measured[n]))).collect();
    let area = area(&measured);
    [inner, outer].map(|radii| (self::area(&radii) / area).sqrt())
}

/// Blur lets plaque next to calcium look like lumen, so the lower bound excludes it. Next to struts is lumen.
fn narrow_beside(inner: &mut [f64], measured: &[f64], hides: impl Fn(usize) -> bool, width: f64) {
    let radii = inner.to_vec();
    let is_wide = |n: usize| {
        let around = |first: usize| (first..first + WIDE).all(|m| hides(m % RAYS));
        (n + RAYS + 1 - WIDE..=n + RAYS).any(around)
    };
    for n in (0..RAYS).filter(|n| is_wide(*n)) {
        let beside = (0.5 * width / measured[n].max(0.5 * width)).asin();
        let count = (beside / TAU * RAYS as f64).ceil() as usize;
        for m in n + RAYS - count..=n + RAYS + count {
            inner[m % RAYS] = inner[m % RAYS].min(radii[n]);
        }
    }
}

fn area(radii: &[f64]) -> f64 {
    let triangle = 0.5 * (TAU / RAYS as f64).sin();
    (0..RAYS).map(|n| triangle * radii[n] * radii[(n + 1) % RAYS]).sum()
}

#[cfg(test)]
#[path = "tests/blooming.rs"]
mod tests;
