//! Estimates centre and radius of the lumen before the fit.

use std::f64::consts::PI;

use glam::DVec2;

use super::SectionPlane;
use super::rays::{Look, RAYS, Ray, Rays, direction};
use crate::voxels::Voxels;
use lumencut_core::math::statistics::median;

/// Minimum intensity of a lumen, as a fraction of the vessel's lumen level.
const LEAST_LUMEN: f64 = 0.25;

/// Rays are cut at this multiple of their median length, because some escape into branches.
const LONGEST_RAY: f64 = 1.6;

/// Maximum number of times that the rays are cast again from the new centre.
const ROUNDS: usize = 4;

#[derive(Clone, Copy, Debug)]
pub(crate) struct LumenEstimate {
    /// Centre of the lumen in the plane (mm).
    pub center: DVec2,
    /// Radius of the lumen (mm).
    pub radius: f64,
    /// Intensity level of the lumen, as a fraction of the contrast.
    pub lumen: f64,
}

/// Minimum intensity of metal or calcium, as a fraction of the contrast.
const BRIGHT: f64 = 1.6;

impl LumenEstimate {
    /// Searches within `search` mm of the centerline for a lumen whose radius is at most `widest` mm.
    pub(crate) fn find(rays: &Rays, place: &SectionPlane, search: f64, widest: f64) -> Option<Self> {
        let mut center = start(rays, place, search)?;
        let mut found = None;
        for _ in 0..ROUNDS {
            let lumen = level(rays, place, center);
            if lumen.is_nan() || lumen < LEAST_LUMEN {
                break;
            }
            let bright = if rays.scale.contrast > 0.0 { BRIGHT.max(1.5 * lumen) } else { f64::INFINITY };
            let look = Look { levels: [lumen, 0.0], bright, rise: 0.25, reach: widest, beyond: 0.0 };
            let (moved, radius) = polygon(&rays.all(place, center, &look))?;
            center += moved;
            found = Some(Self { center, radius, lumen });
            if moved.length() < 0.05 * radius {
                break;
            }
        }
        found
    }
}

/// Start point of the rays: the centerline point if it lies in lumen, otherwise the best point nearby.
fn start(rays: &Rays, place: &SectionPlane, search: f64) -> Option<DVec2> {
    if level(rays, place, DVec2::ZERO) > 0.5 {
        return Some(DVec2::ZERO);
    }
    let step = search_step(rays.voxels, search);
    let count = (search / step).ceil() as i32;
    let mut best: Option<(f64, DVec2)> = None;
    for j in -count..=count {
        for i in -count..=count {
            let point = DVec2::new(f64::from(i), f64::from(j)) * step;
            if point.length() > search {
                continue;
            }
            let lumen = level(rays, place, point);
            // Points farther from the centerline need a higher level.
            let score = lumen.min(1.0) - 0.3 * point.length() / search;
            if lumen.is_finite() && best.is_none_or(|(most, _)| score > most) {
                best = Some((score, point));
            }
        }
    }
    best.map(|(_, point)| point)
}

/// Step of the search grid (mm): at most as many points as the volume has voxels, because any radius may be given.
fn search_step(voxels: &Voxels, search: f64) -> f64 {
    let count: f64 = voxels.size.iter().map(|n| *n as f64).product();
    voxels.sampling_side.max(2.0 * search / count.sqrt())
}

fn level(rays: &Rays, place: &SectionPlane, center: DVec2) -> f64 {
    let near = 0.5 * rays.voxels.sampling_side;
    let mut values = vec![rays.at(place, center)];
    values.extend((0..8).map(|n| rays.at(place, center + direction(n * RAYS / 8) * near)));
    values.retain(|value| value.is_finite());
    median(&mut values).unwrap_or(f64::NAN)
}

/// Centroid and equivalent radius of the polygon whose corners are the ends of the rays.
fn polygon(rays: &[Ray]) -> Option<(DVec2, f64)> {
    let mut edges: Vec<f64> = rays.iter().filter_map(Ray::end).collect();
    if edges.len() < RAYS / 4 {
        return None;
    }
    let middle = median(&mut edges)?;
    let length = |n: usize| rays[n].end().unwrap_or(middle).min(LONGEST_RAY * middle);
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for n in 0..RAYS {
        let next = (n + 1) % RAYS;
        let [a, b] = [direction(n) * length(n), direction(next) * length(next)];
        let triangle = 0.5 * a.perp_dot(b);
        area += triangle;
        moment += (a + b) * (triangle / 3.0);
    }
    (area > 0.0).then(|| (moment / area, (area / PI).sqrt()))
}

#[cfg(test)]
#[path = "tests/lumen_estimate.rs"]
mod tests;
