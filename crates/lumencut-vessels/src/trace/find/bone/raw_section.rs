//! What the raw voxels show across a track: how long and how even its cross-section is, and whether it is marrow in a cortex.
//!
//! Tubes are found where bright values are cut off. There a plate of bone looks like a tube; the raw voxels show that it is none.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::trace::find::quantiles::{median, quantile};
use crate::trace::find::scan::Scan;
use crate::trace::find::section::{TOUCHED, across};
use crate::trace::find::track::TrackPoint;
use crate::trace::lumen::ray::Ray;

/// With how many rays a cross-section is looked at: an even number, as opposite ones make a diameter.
const RAYS: usize = 24;

/// The distance of samples along a ray (voxels).
const STEP: f64 = 0.5;

/// How far out the tissue around a lumen is looked for: in radii from the first to the last, and voxels beyond.
const TISSUE: [f64; 2] = [0.8, 1.6];
const TISSUE_BEYOND: f64 = 2.0;

/// The share of the rays that end in darker tissue than what counts as the tissue.
const TISSUE_SHARE: f64 = 0.3;

/// How far a ray goes at most: the smaller one of two lengths, each in radii and further millimetres.
const REACH: [[f64; 2]; 2] = [[3.0, 4.0], [6.0, 1.5]];

/// A lumen that bone may touch, whose level is no farther from the usual one than this part of the contrast, ends at the darkest place
/// before bone, which is brighter than the usual level by the second part.
const ALIKE: f64 = 0.15;
const BONE: f64 = 0.4;

/// Diameters below this are not told apart (voxels).
const LEAST_DIAMETER: f64 = 0.8;

/// Where the level of the lumen is taken, and where its spread (radii).
const LEVEL_WITHIN: [f64; 2] = [0.2, 0.4];
const SPREAD_WITHIN: [f64; 3] = [0.25, 0.45, 0.65];

/// The part of the standard deviation that lies between the quartiles of normal values.
const QUARTILES: f64 = 1.35;

/// How far out a cortex is looked for: in radii from the first to the last, and millimetres beyond.
const CORTEX: [f64; 2] = [0.8, 2.5];
const CORTEX_BEYOND: f64 = 2.0;

/// Marrow in a cortex: over more than this share of the rays brighter than inside, by this part of the usual contrast or so
/// many standard deviations of the noise; inside darker than vessels by the second part, with a standard deviation above the third
/// part, or darker by the fourth part; the radius at least so many voxels.
const CORTEX_SHARE: f64 = 0.7;
const CORTEX_ABOVE: f64 = 0.15;
const CORTEX_NOISE: f64 = 3.0;
const MARROW_BELOW: f64 = 0.08;
const MARROW_SPREAD: f64 = 0.2;
const MARROW_FAR_BELOW: f64 = 0.2;
const MARROW_RADIUS: f64 = 1.5;

/// What the raw voxels show across a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RawSection {
    /// The level inside.
    pub level: f64,
    /// The greatest diameter at half level as a multiple of the least one.
    pub elongation: f64,
    /// The spread of the values inside, as a share of the usual contrast of vessels.
    pub spread: f64,
    /// Whether it is marrow in a cortex.
    pub is_marrow: bool,
}

impl RawSection {
    /// The section at a point of a track; none where it is no brighter than its surroundings.
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

/// Values in the middle of a lumen and around it at some shares of its radius; none from outside the volume.
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

/// Whether a section is that of marrow in a cortex.
fn is_marrow(scan: &Scan, level: f64, values: &[f64], rays: &mut Rays) -> bool {
    let is_dark = level < scan.level - MARROW_BELOW * scan.contrast;
    let is_wide = rays.radius > MARROW_RADIUS * scan.side;
    let is_far_darker = level < scan.level - MARROW_FAR_BELOW * scan.contrast;
    is_dark
        && is_wide
        && (is_far_darker || standard_deviation(values) > MARROW_SPREAD * scan.contrast)
        && rays.brighter(level + (CORTEX_NOISE * scan.noise).max(CORTEX_ABOVE * scan.contrast)) > CORTEX_SHARE
}

/// The rays across a track.
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

    /// The numbers of the samples that a range covers, given in radii and by what it goes beyond (mm).
    fn samples(&self, [first, last]: [f64; 2], beyond: f64) -> [usize; 2] {
        let number = |length: f64| (length / self.step).round() as usize;
        [number(first * self.radius), number(last * self.radius + beyond).max(1)]
    }

    /// The level of the tissue around: not of its darkest part, where that is fat or lung.
    fn tissue(&mut self, scan: &Scan) -> f64 {
        let [first, last] = self.samples(TISSUE, TISSUE_BEYOND * scan.side);
        let mut darkest: Vec<f64> =
            self.rays.iter_mut().map(|ray| ray.extreme(first, last, true).max(scan.lowest)).collect();
        quantile(&mut darkest, TISSUE_SHARE).unwrap_or(f64::MAX)
    }

    /// The share of the rays that are somewhere near the wall brighter than a limit.
    fn brighter(&mut self, limit: f64) -> f64 {
        let [first, last] = self.samples(CORTEX, CORTEX_BEYOND);
        let brightest = self.rays.iter_mut().map(|ray| ray.extreme(first, last, false));
        brightest.filter(|value| *value > limit).count() as f64 / RAYS as f64
    }

    /// The greatest diameter at a level as a multiple of the least one.
    fn elongation(&mut self, scan: &Scan, level: f64, half: f64) -> f64 {
        let most = REACH.map(|[radii, beyond]| radii * self.radius + beyond);
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

/// The length of a ray to where it first falls below a level, or leaves the volume, in steps and at most `last` of them.
fn length(ray: &mut Ray, level: f64, last: usize) -> f64 {
    let is_out = |value: f64| value < level || value.is_nan();
    let Some(out) = (0..=last).find(|n| is_out(ray.value(*n))) else { return last as f64 };
    let [inside, outside] = [out.saturating_sub(1), out].map(|n| ray.value(n));
    let share = (inside - level) / (inside - outside);
    // The middle itself may lie below, and what lies outside is no number.
    out.saturating_sub(1) as f64 + if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
}

/// The length of a ray to the darkest place of the outer half of its way to bone, the last of several, in steps; none where it meets
/// no bone, or falls below a level before.
fn to_bone(ray: &mut Ray, level: f64, bone: f64, last: usize) -> Option<f64> {
    let first = (0..=last).find(|n| !(level..=bone).contains(&ray.value(*n)))?;
    let values: Vec<f64> = (0..=first).map(|n| ray.value(n)).collect();
    let outer = (first / 2..first).rev();
    let darkest = outer.min_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
    (values[first] > bone).then_some(darkest as f64)
}

/// How far the quartiles of some values are apart.
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
