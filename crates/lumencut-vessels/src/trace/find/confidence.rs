//! The confidence that a track is a vessel: a product of criteria, weighted by exponents.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::trace::find::pyramid::Pyramid;
use crate::trace::find::quantiles::lower_median;
use crate::trace::find::section::{TOUCHED, across};
use crate::trace::find::track::{TrackDoubt, TrackPoint, length, usual};
use crate::voxels::Voxels;

/// The intensity level and contrast that vessels usually have, in the unit of the volume.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UsualVessels {
    pub level: f64,
    pub contrast: f64,
}

/// Exponent of the product of all criteria, and minimum of each factor.
const POWER: f64 = 0.6;
const MIN_FACTOR: f64 = 0.02;

/// The ring around the lumen starts and ends at these distances: a multiple of the radius plus some voxels.
const RING_FROM: [f64; 2] = [1.25, 0.7];
const RING_TO: [f64; 2] = [2.05, 2.0];
const RAYS: usize = 16;
/// Around narrow tubes, rays that meet bone are ignored if at least this many others remain.
const LEAST_LEFT: usize = 6;
const SAMPLES: usize = 4;

const MOST_SECTIONS: usize = 60;

/// A tube becomes wide over this range of radii (voxels).
const WIDE_VOXELS: [f64; 2] = [2.5, 5.5];

/// Bone is searched up to this distance (radii plus voxels); it exceeds vessels by `BONE` times the contrast.
const BONE_REACH: [f64; 2] = [1.5, 1.5];
const BONE: f64 = 0.4;
const BRIGHT_INSIDE: f64 = 0.5;
/// A wide tube may have bright walls (stent) if its level differs from vessels by less than the second value
/// (times the contrast), and more so towards the first.
const STENT_INSIDE: [f64; 2] = [0.25, 0.55];

struct Around {
    /// Fraction of directions with a dark ring; median interquartile range of the ring divided by the contrast.
    dark: f64,
    even: f64,
    /// Contrast between lumen and ring, divided by the vessel contrast.
    contrast: f64,
    /// Fraction of rays that meet bone.
    bone: f64,
    inside: f64,
}

/// Rises linearly from 0 at `from` to 1 at `to`.
pub(crate) fn ramp(value: f64, from: f64, to: f64) -> f64 {
    ((value - from) / (to - from)).clamp(0.0, 1.0)
}

/// Confidence (0 to 1) and main doubt of a track, whose points are in finest-level voxels.
pub(crate) fn confidence(
    pyramid: &Pyramid,
    voxels: &Voxels,
    points: &[TrackPoint],
    vessels: &UsualVessels,
) -> (f64, Option<TrackDoubt>) {
    let good: Vec<&TrackPoint> = points.iter().filter(|point| point.is_good).collect();
    if good.is_empty() {
        return (0.0, Some(TrackDoubt::Open));
    }
    let radius = usual(good.iter().copied(), |point| point.radius);
    let around = around(pyramid, voxels, &good, vessels);
    let wide = ramp(radius, WIDE_VOXELS[0], WIDE_VOXELS[1]);
    let closure = good.iter().map(|point| point.closure).sum::<f64>() / good.len() as f64;
    let share = good.len() as f64 / points.len() as f64;
    let parts = [
        (ramp(around.dark, 0.60 - 0.1 * wide, 0.85 - 0.1 * wide), 1.0, TrackDoubt::BrightSides),
        (ramp(-around.even, -(0.75 + 0.3 * wide), -0.30), 1.0, TrackDoubt::BrightSides),
        (ramp(closure, 0.75, 0.90), 0.7, TrackDoubt::Open),
        (ramp(around.contrast, 0.12, 0.37), 0.7, TrackDoubt::Faint),
        (ramp(length(points) / radius, 2.0, 8.0), 0.5, TrackDoubt::Short),
        (ramp(-radius_roughness(&good, radius), -0.25, -0.15), 0.7, TrackDoubt::Rough),
        (no_bone(&around, wide, vessels), 1.0, TrackDoubt::BrightSides),
        (ramp(share, 0.5, 0.8), 0.5, TrackDoubt::Open),
    ];
    let weighed = parts.map(|(part, weight, doubt)| (weight * part.max(MIN_FACTOR).ln(), doubt));
    let sum: f64 = weighed.iter().map(|(part, _)| part).sum();
    let worst = weighed.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(part, _)| *part < 0.0);
    ((POWER * sum).exp(), worst.map(|(_, doubt)| doubt))
}

fn radius_roughness(good: &[&TrackPoint], radius: f64) -> f64 {
    let steps: Vec<f64> = good.windows(2).map(|pair| pair[1].radius - pair[0].radius).collect();
    if steps.is_empty() {
        return 0.0;
    }
    let mean = steps.iter().sum::<f64>() / steps.len() as f64;
    let square = steps.iter().map(|step| (step - mean).powi(2)).sum::<f64>() / steps.len() as f64;
    square.sqrt() / radius
}

/// Factor that is 1 if neither the inside nor the walls are as bright as bone.
fn no_bone(around: &Around, wide: f64, usual: &UsualVessels) -> f64 {
    let bright = ramp(-around.bone, -0.75, -0.40);
    let away = (around.inside - usual.level).abs() / usual.contrast;
    let excused = wide * ramp(-away, -STENT_INSIDE[1], -STENT_INSIDE[0]);
    let too_bright = (around.inside - usual.level) / usual.contrast;
    let inside = 1.0 - ramp(too_bright, BRIGHT_INSIDE, 2.0 * BRIGHT_INSIDE);
    inside * bright.max(excused)
}

fn around(pyramid: &Pyramid, voxels: &Voxels, good: &[&TrackPoint], usual: &UsualVessels) -> Around {
    let step = good.len().div_ceil(MOST_SECTIONS);
    let mut parts: [Vec<f64>; 5] = std::array::from_fn(|_| Vec::with_capacity(MOST_SECTIONS));
    for point in good.iter().step_by(step) {
        let section = of_section(pyramid, voxels, point, usual);
        for (part, value) in parts.iter_mut().zip(section) {
            part.push(value);
        }
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (dark, bone) = (mean(&parts[0]), mean(&parts[3]));
    let [even, contrast, inside] = [1, 2, 4].map(|n: usize| lower_median(&mut parts[n]).unwrap_or(0.0));
    Around { dark, even, contrast, bone, inside }
}

fn of_section(pyramid: &Pyramid, voxels: &Voxels, point: &TrackPoint, usual: &UsualVessels) -> [f64; 5] {
    let level = pyramid.level_for(point.radius, &pyramid.all());
    let plane = across(point.direction);
    let [from, to] = [RING_FROM, RING_TO].map(|[radii, more]| radii * point.radius + more);
    let raw = |place: DVec3| f64::from(voxels.at(pyramid.grid.world(place)));
    let bone = usual.level + BONE * usual.contrast;
    let reach = BONE_REACH[0] * point.radius + BONE_REACH[1];
    let mut means = Vec::with_capacity(RAYS);
    let mut in_bone = Vec::new();
    for n in 0..RAYS {
        let (sin, cos) = (TAU * n as f64 / RAYS as f64).sin_cos();
        let ray = plane[0] * cos + plane[1] * sin;
        let value = |m: usize| {
            let length = from + (to - from) * (m as f64 + 0.5) / SAMPLES as f64;
            f64::from(level.at(point.place + ray * length))
        };
        let values: [f64; SAMPLES] = std::array::from_fn(value);
        let mean = values.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).fold(f64::MAX, f64::min);
        let samples = (reach / 0.5).ceil().max(1.0) as usize;
        let meets =
            (1..=samples).any(|m| raw(point.place + ray * (reach * m as f64 / samples as f64)) > bone);
        if meets { &mut in_bone } else { &mut means }.push(mean);
    }
    let meeting = in_bone.len() as f64 / RAYS as f64;
    if means.len() < LEAST_LEFT || point.radius > TOUCHED {
        means.append(&mut in_bone);
    }
    let count = means.len();
    let dark = means.iter().filter(|mean| **mean < point.level - 0.5 * point.contrast).count();
    means.sort_unstable_by(f64::total_cmp);
    let even = (means[9 * count / 16] - means[count / 16]) / point.contrast;
    let mut inside: Vec<f64> = (0..6)
        .map(|n| {
            let (sin, cos) = (TAU * f64::from(n) / 6.0).sin_cos();
            raw(point.place + (plane[0] * cos + plane[1] * sin) * (0.4 * point.radius))
        })
        .chain([raw(point.place)])
        .filter(|value| value.is_finite())
        .collect();
    let inside = lower_median(&mut inside).unwrap_or(point.level);
    let contrast = (point.level - means[count / 2]) / usual.contrast;
    [dark as f64 / count as f64, even, contrast, meeting, inside]
}

#[cfg(test)]
#[path = "tests/confidence.rs"]
mod tests;
