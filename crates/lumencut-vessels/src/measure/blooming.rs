//! How wide a lumen beside calcium or metal may be: these look larger than they are, and hide where the lumen ends.

use std::f64::consts::TAU;

use super::flags::{CALCIUM, METAL};
use super::obstacles::is_bright;
use super::rays::{RAYS, Ray};

/// A stent goes on between rings that are no farther apart than this (mm).
const RINGS: f64 = 6.0;

/// It goes on too between places that are no farther apart than this (mm) where something is bright all the way: struts that are
/// blurred into arcs look like calcium, and no calcium begins and ends with metal.
const BRIGHT_BETWEEN: f64 = 40.0;

/// How much smaller and larger a diameter is at most, as factors of it: if nothing that is brighter than lumen at its wall is
/// lumen, as far inwards as it looks bright, and if all of it is. `wall` is where the lumen was measured to end (mm) along a
/// ray, under a blur of this width (mm).
pub fn bounds(rays: &[Ray], wall: impl Fn(usize) -> f64, width: f64) -> [f64; 2] {
    // What lies behind the edge of the lumen is no part of it.
    let hides = |n: usize| rays[n].edge.is_none() && is_bright(&rays[n], wall(n), width);
    let measured: Vec<f64> = (0..RAYS).map(&wall).collect();
    let bound = |n: usize, other: f64| if hides(n) { other } else { measured[n] };
    let inner: Vec<f64> = (0..RAYS).map(|n| bound(n, rays[n].rim[0].min(measured[n]))).collect();
    let outer: Vec<f64> = (0..RAYS).map(|n| bound(n, rays[n].rim[1].max(measured[n]))).collect();
    let area = area(&measured);
    [inner, outer].map(|radii| (self::area(&radii) / area).sqrt())
}

/// The area within points along all rays, as far from their middle (mm).
fn area(radii: &[f64]) -> f64 {
    let triangle = 0.5 * (TAU / RAYS as f64).sin();
    (0..RAYS).map(|n| triangle * radii[n] * radii[(n + 1) % RAYS]).sum()
}

/// Makes one stretch of metal of the rings of a stent, by their arc lengths (mm): between them it is metal too, and what is bright
/// there no calcium. So it is between places farther apart where all sections between are bright.
pub fn join_rings(at: &[f64], flags: &mut [u32]) {
    let rings: Vec<usize> = (0..at.len()).filter(|n| flags[*n] & METAL != 0).collect();
    for two in rings.windows(2) {
        let away = at[two[1]] - at[two[0]];
        let is_bright = flags[two[0] + 1..two[1]].iter().all(|flags| flags & CALCIUM != 0);
        if away <= RINGS || is_bright && away <= BRIGHT_BETWEEN {
            for flags in &mut flags[two[0] + 1..two[1]] {
                *flags = *flags & !CALCIUM | METAL;
            }
        }
    }
}

#[cfg(test)]
#[path = "tests/blooming.rs"]
mod tests;
