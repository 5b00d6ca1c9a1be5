//! Cross-section of a track in the raw voxels: its elongation, its evenness, and whether it is marrow. Tracking uses
//! clipped values, so a plate of bone may look like a tube; raw voxels show the difference.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::trace::find::quantiles::{median, quantile};
use crate::trace::find::scan::Scan;
use crate::trace::find::section::{TOUCHED, across};
use crate::trace::find::track::TrackPoint;
use crate::trace::lumen::cross_section::Ray;

/// Number of rays. It is even, because two opposite rays form a diameter.
const RAYS: usize = 24;

/// Distance between samples of a ray (voxels).
const STEP: f64 = 0.5;

/// Tissue is searched between these multiples of the radius; the far end is `TISSUE_BEYOND` voxels farther.
const TISSUE: [f64; 2] = [0.8, 1.6];
const TISSUE_BEYOND: f64 = 2.0;

/// Quantile of the lowest values of all rays that counts as tissue, because fat and lung are darker.
const TISSUE_SHARE: f64 = 0.3;

/// Maximum length of a ray: the smaller of two sums, each of a multiple of the radius and some mm.
const RAY_LENGTHS: [[f64; 2]; 2] = [[3.0, 4.0], [6.0, 1.5]];

/// Lumen differs from the vessel level by less than `ALIKE`, bone exceeds it by `BONE` (fractions of the contrast).
const ALIKE: f64 = 0.15;
const BONE: f64 = 0.4;

/// Smallest diameter that can be resolved (voxels).
const LEAST_DIAMETER: f64 = 0.8;

/// Distances from the centre (radii) at which values are sampled, for the level and for the spread.
const LEVEL_WITHIN: [f64; 2] = [0.2, 0.4];
const SPREAD_WITHIN: [f64; 3] = [0.25, 0.45, 0.65];

/// Interquartile range of a normal distribution, in standard deviations.
const QUARTILES: f64 = 1.35;

/// Compact bone is searched between these multiples of the radius; the far end is `CORTEX_BEYOND` mm farther.
const CORTEX: [f64; 2] = [0.8, 2.5];
const CORTEX_BEYOND: f64 = 2.0;

/// Marrow: on `CORTEX_SHARE` of the rays, values exceed the inside by `CORTEX_ABOVE` of the contrast, or
/// `CORTEX_NOISE` times the noise if larger. The inside is dark and uneven, or very dark; the radius has a minimum
/// (voxels).
const CORTEX_SHARE: f64 = 0.7;
const CORTEX_ABOVE: f64 = 0.15;
const CORTEX_NOISE: f64 = 3.0;
const MARROW_BELOW: f64 = 0.08;
const MARROW_SPREAD: f64 = 0.2;
const MARROW_FAR_BELOW: f64 = 0.2;
const MARROW_RADIUS: f64 = 1.5;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RawSection {
    pub level: f64,
    pub(crate) elongation: f64,
    pub spread: f64,
    pub(crate) is_marrow: bool,
}

impl RawSection {
    /// The section at a point; None if it is no brighter than its surroundings.
    pub(crate) fn at(scan: &Scan, point: &TrackPoint) -> Option<Self> {
        let [u, v] = across(point.direction);
        let level = median(&mut inside(scan, point, [u, v], &LEVEL_WITHIN))?;
        let values = inside(scan, point, [u, v], &SPREAD_WITHIN);
        let mut rays = Rays::from(scan, point, [u, v]);
        let tissue = rays.tissue(scan);
        let is_bright = level > tissue;
        is_bright.then(|| Self {
            level,
            elongation: rays.elongation(scan, level, f64::midpoint(level, tissue)),
            spread: between_quartiles(values.clone()) / QUARTILES / scan.contrast,
            is_marrow: is_marrow(scan, level, &values, &mut rays),
        })
    }
}

fn inside(scan: &Scan, point: &TrackPoint, [u, v]: [DVec3; 2], shares: &[f64]) -> Vec<f64> {
    let around = shares.iter().flat_map(|share| {
        (0..8).map(move |n| {
            let (sin, cos) = (TAU * f64::from(n) / 8.0).sin_cos();
            point.place + (u * cos + v * sin) * (share * point.radius)
        })
    });
    let places = std::iter::once(point.place).chain(around);
    places.map(|place| f64::from(scan.voxels.at(place))).filter(|value| value.is_finite()).collect()
}

fn is_marrow(scan: &Scan, level: f64, values: &[f64], rays: &mut Rays) -> bool {
    let is_dark = level < scan.level - MARROW_BELOW * scan.contrast;
    let is_wide = rays.radius > MARROW_RADIUS * scan.side;
    let is_far_darker = level < scan.level - MARROW_FAR_BELOW * scan.contrast;
    is_dark
        && is_wide
        && (is_far_darker || standard_deviation(values) > MARROW_SPREAD * scan.contrast)
        && rays.brighter(level + (CORTEX_NOISE * scan.noise).max(CORTEX_ABOVE * scan.contrast)) > CORTEX_SHARE
}

struct Rays<'a, 'v> {
    rays: Vec<Ray<'a, 'v>>,
    radius: f64,
    step: f64,
}

impl<'a, 'v> Rays<'a, 'v> {
    fn from(scan: &Scan<'v>, point: &TrackPoint, [u, v]: [DVec3; 2]) -> Self {
        let step = STEP * scan.voxels.sampling_side;
        let to_index = scan.voxels.index_from_world;
        let start = to_index.transform_point3(point.place);
        let ray = |n: usize| {
            let (sin, cos) = (TAU * n as f64 / RAYS as f64).sin_cos();
            Ray::new(scan.voxels, start, to_index.transform_vector3(u * cos + v * sin) * step)
        };
        Self { rays: (0..RAYS).map(ray).collect(), radius: point.radius, step }
    }

    fn samples(&self, [first, last]: [f64; 2], beyond: f64) -> [usize; 2] {
        let number = |length: f64| (length / self.step).round() as usize;
        [number(first * self.radius), number(last * self.radius + beyond).max(1)]
    }

    fn tissue(&mut self, scan: &Scan) -> f64 {
        let [first, last] = self.samples(TISSUE, TISSUE_BEYOND * scan.side);
        let mut darkest: Vec<f64> =
            self.rays.iter_mut().map(|ray| ray.extreme(first, last, true).max(scan.lowest)).collect();
        quantile(&mut darkest, TISSUE_SHARE).unwrap_or(f64::MAX)
    }

    fn brighter(&mut self, limit: f64) -> f64 {
        let [first, last] = self.samples(CORTEX, CORTEX_BEYOND);
        let brightest = self.rays.iter_mut().map(|ray| ray.extreme(first, last, false));
        brightest.filter(|value| *value > limit).count() as f64 / RAYS as f64
    }

    fn elongation(&mut self, scan: &Scan, level: f64, half: f64) -> f64 {
        let most = RAY_LENGTHS.map(|[radii, beyond]| radii * self.radius + beyond);
        let last = (most[0].min(most[1]) / self.step).ceil() as usize;
        let step = self.step;
        let is_alike = (level - scan.level).abs() < ALIKE * scan.contrast;
        let may_touch = is_alike && self.radius <= TOUCHED * scan.side;
        let bone = if may_touch { scan.level + BONE * scan.contrast } else { f64::MAX };
        let within =
            |ray: &mut Ray| to_bone(ray, half, bone, last).unwrap_or_else(|| length(ray, half, last)) * step;
        let lengths: Vec<f64> = self.rays.iter_mut().map(within).collect();
        let diameters = (0..RAYS / 2).map(|n| lengths[n] + lengths[n + RAYS / 2]);
        let [least, greatest] =
            diameters.fold([f64::MAX, 0.0_f64], |[least, greatest], d| [least.min(d), greatest.max(d)]);
        greatest / least.max(LEAST_DIAMETER * scan.side)
    }
}

/// Distance (in steps) along a ray to the first value below `level`, at most `last`.
fn length(ray: &mut Ray, level: f64, last: usize) -> f64 {
    let is_out = |value: f64| value < level || value.is_nan();
    let Some(out) = (0..=last).find(|n| is_out(ray.value(*n))) else { return last as f64 };
    let [inside, outside] = [out.saturating_sub(1), out].map(|n| ray.value(n));
    let share = (inside - level) / (inside - outside);
    // The centre itself may be below `level`, and the value outside may be NaN.
    out.saturating_sub(1) as f64 + if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
}

/// Distance (in steps) to the darkest sample in the outer half of a ray before bone; None if it meets no bone.
fn to_bone(ray: &mut Ray, level: f64, bone: f64, last: usize) -> Option<f64> {
    let first = (0..=last).find(|n| !(level..=bone).contains(&ray.value(*n)))?;
    let values: Vec<f64> = (0..=first).map(|n| ray.value(n)).collect();
    let outer = (first / 2..first).rev();
    let darkest = outer.min_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
    (values[first] > bone).then_some(darkest as f64)
}

fn between_quartiles(mut values: Vec<f64>) -> f64 {
    let [low, high] = [0.25, 0.75].map(|share| quantile(&mut values, share).unwrap_or(0.0));
    high - low
}

fn standard_deviation(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
#[path = "tests/raw_section.rs"]
mod tests;
