//! Finds obstacles in a section, and the voxels that they affect.

pub(crate) mod blooming;
pub(crate) mod branches;
pub(crate) mod bright_side;
pub(crate) mod plaque;

use std::f64::consts::TAU;

use glam::DVec2;

use crate::measure::section::flags::{BRANCH, CALCIUM, METAL, NEIGHBOR, OUTSIDE};
use crate::measure::section::rays::{RAYS, Ray};
use lumencut_core::math::statistics::median;

/// Width of the margin around bright obstacles, in blur widths.
const BRIGHT_MARGIN: f64 = 0.8;

/// Calcium up to this distance from the lumen (mm) belongs to the wall; structures farther away are neighbours.
const WALL_CALCIUM_MM: f64 = 1.5;

/// Minimum number of rays that meet an obstacle, and of rays that meet a stent all around the lumen.
const LEAST_RAYS: usize = 3;
const ALL_AROUND: usize = RAYS * 3 / 5;

/// Bright spots are the struts of a stent if at least this many rays meet them, in total and in each quarter
/// of the circle. Calcium lies on only one or two sides.
const LATTICE: [usize; 2] = [RAYS * 2 / 5, RAYS / 16];

/// Values above this are metal: they exceed the lumen by at least four times the contrast.
const METAL_SHARE: f64 = 5.0;

/// The lumen continues sideways if some rays stay inside it beyond this multiple of the wall distance.
const OPEN: f64 = 1.6;

/// Maximum distance from the centre, in each direction, at which voxels are used.
#[derive(Clone, Debug)]
pub(crate) struct Obstacles {
    center: DVec2,
    limit: [f64; RAYS],
    nearest: f64,
    /// Fraction of directions in which nothing obstructs the wall.
    pub free: f64,
}

impl Obstacles {
    pub(crate) fn new(rays: &[Ray], center: DVec2, width: f64) -> Self {
        let mut edges: Vec<f64> = rays.iter().filter_map(|ray| ray.edge).collect();
        let middle = median(&mut edges).unwrap_or(f64::INFINITY);
        let own: Vec<f64> = rays.iter().map(|ray| limit(ray, middle, width)).collect();
        let mut all = Self { center, limit: [f64::INFINITY; RAYS], nearest: f64::INFINITY, free: 0.0 };
        for (n, &limit) in own.iter().enumerate() {
            if !limit.is_finite() {
                continue;
            }
            // Blur makes an obstacle affect neighbouring directions.
            let beside = (0.5 * width / limit.max(0.5 * width)).asin();
            let count = ((beside / TAU * RAYS as f64).ceil() as usize).min(RAYS / 4);
            for m in n + RAYS - count..=n + RAYS + count {
                let there = &mut all.limit[m % RAYS];
                *there = there.min(limit);
            }
        }
        all.nearest = all.limit.iter().copied().fold(f64::INFINITY, f64::min);
        let is_free = |limit: &&f64| **limit > middle + 0.5 * width;
        all.free = all.limit.iter().filter(is_free).count() as f64 / RAYS as f64;
        all
    }

    pub(crate) fn keeps(&self, point: DVec2) -> bool {
        let away = point - self.center;
        let length = away.length();
        if length <= self.nearest {
            return true;
        }
        let turn = away.y.atan2(away.x).rem_euclid(TAU) / TAU;
        let ray = (turn * RAYS as f64).round() as usize % RAYS;
        length <= self.limit[ray]
    }
}

fn limit(ray: &Ray, middle: f64, width: f64) -> f64 {
    let is_open = ray.edge.is_none_or(|edge| edge > OPEN * middle + 0.5 * width);
    match ray.bright_at {
        Some(at) if ray.edge.is_none() => (at - BRIGHT_MARGIN * width).max(0.0),
        None if is_open && ray.outside_at.is_none() => 0.7 * middle,
        _ => ray.limit,
    }
}

/// Whether a ray meets calcium or metal near the wall. The wall is `wall` mm from the ray's start; `width` is
/// the blur (mm).
pub(crate) fn is_bright(ray: &Ray, wall: f64, width: f64) -> bool {
    ray.bright_at.is_some_and(|at| at < wall + WALL_CALCIUM_MM.max(width))
}

fn is_lattice(is_bright: impl Fn(usize) -> bool) -> bool {
    let quarter = RAYS / 4;
    let counts: Vec<usize> =
        (0..4).map(|q| (q * quarter..(q + 1) * quarter).filter(|n| is_bright(*n)).count()).collect();
    let [all, each] = LATTICE;
    counts.iter().sum::<usize>() >= all && counts.iter().all(|count| *count >= each)
}

/// Flags of a section from its rays; `wall` gives the distance of the wall on each ray (mm), `width` the blur (mm).
pub(crate) fn flags_of(rays: &[Ray], wall: impl Fn(usize) -> f64, width: f64) -> u32 {
    let count = |is: &dyn Fn(usize, &Ray) -> bool| rays.iter().enumerate().filter(|(n, r)| is(*n, r)).count();
    let beside = WALL_CALCIUM_MM.max(width);
    let is_bright = |n: usize, ray: &Ray| is_bright(ray, wall(n), width);
    let bright = count(&is_bright);
    let is_metal = |n: usize, ray: &Ray| is_bright(n, ray) && ray.brightest > METAL_SHARE;
    let neighbors = count(&|n, ray| ray.edge.is_some() && ray.limit < wall(n) + beside);
    let open = count(&|n, ray| {
        let reached = ray.edge.unwrap_or(ray.limit.min(1e9));
        ray.bright_at.is_none() && ray.outside_at.is_none() && reached > OPEN * wall(n) + 0.5 * width
    });
    let mut flags = 0;
    if bright >= LEAST_RAYS {
        let is_stent = bright >= ALL_AROUND || is_lattice(|n| is_bright(n, &rays[n]));
        flags |= if is_stent || count(&is_metal) >= LEAST_RAYS { METAL } else { CALCIUM };
    }
    if neighbors >= LEAST_RAYS {
        flags |= NEIGHBOR;
    }
    if open >= LEAST_RAYS {
        flags |= BRANCH;
    }
    if count(&|n, ray| ray.outside_at.is_some_and(|at| at < wall(n) + width)) > 0 {
        flags |= OUTSIDE;
    }
    flags
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn struts_all_around_are_a_stent_and_calcium_on_one_or_two_sides_is_none() {
        // A lattice: struts that each cover four rays, with gaps of five rays.
        assert!(is_lattice(|n| n % 9 < 4));
        // No lattices: one half of the wall; two opposite quarters; struts that are too narrow.
        assert!(!is_lattice(|n| n < 32));
        assert!(!is_lattice(|n| n % 32 < 16));
        assert!(!is_lattice(|n| n % 9 < 3));
    }
}
