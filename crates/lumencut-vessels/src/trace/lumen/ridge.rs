//! Moves the line of a wide lumen towards the ridge of the distances from its wall, where the line runs far off it.
//! Sections cannot do that: on a zigzag their planes are wrong. The ridge alone is worse than a line that is good.

use std::ops::Range;

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::even_steps::in_even_steps;
use crate::trace::lines::nearest_point;
use crate::trace::lines::smoothing::smoothed_by_gaussian;
use crate::trace::lumen::distance_map::{DistanceMap, LumenPoint};
use crate::trace::lumen::lumen_model::lower_median;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::stop::{Stop, go_on};

/// Smallest radius of a wide lumen (voxel sides); in narrower ones the distance from the wall is too coarse.
const WIDE: f64 = 4.0;

/// The level of the lumen is the median along this many radii before and after a point.
const LEVEL_WITHIN: f64 = 3.0;

/// A stretch that moves is at least this long (radii).
const LEAST_LENGTH: f64 = 4.0;

/// Half the window (mm) in which the median of the radii is the radius of the lumen.
const WINDOW: f64 = 10.0;

/// The line moves where its distance from the wall is less than this fraction of the ridge's; fully from `FULL` less.
const OFF: f64 = 0.85;
const FULL: f64 = 0.1;

/// A ridge farther from the wall than this (usual radii) is that of several lumens, such as both limbs of a stent.
const OTHER: f64 = 1.15;

/// Standard deviations of the Gaussians that smooth the ridge and the movement (radii).
const RIDGE_SMOOTHED: f64 = 0.3;
const MOVE_SMOOTHED: f64 = 0.5;

/// Distances between the points around which the map is made, and between those of the ridge (radii).
const STEP: f64 = 0.25;
const RIDGE_STEP: f64 = 0.1;

/// A map covers a piece of this length and a margin before and after it (radii), which bounds its memory.
const PIECE: f64 = 24.0;
const MARGIN: f64 = 5.0;

/// The line with its wide stretches moved; `tissue` is the level around the lumen. Number and order of the points stay.
pub(crate) fn on_ridge(voxels: &Voxels, tissue: f64, mut line: Centerline, stop: Stop) -> Result<Centerline> {
    let lengths = arc_lengths(&line.points);
    let radii = usual_radii(&line, &lengths);
    for stretch in wide(&radii, &lengths, WIDE * voxels.mean_side()) {
        go_on(stop)?;
        move_stretch(voxels, tissue, &mut line, &radii, stretch);
    }
    Ok(line)
}

fn usual_radii(line: &Centerline, lengths: &[f64]) -> Vec<f64> {
    let usual = |at: &f64| {
        let first = lengths.partition_point(|length| *length < at - WINDOW);
        let end = lengths.partition_point(|length| *length <= at + WINDOW);
        lower_median(line.radius[first..end].to_vec())
    };
    lengths.iter().map(usual).collect()
}

fn wide(radii: &[f64], lengths: &[f64], least: f64) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut from = 0;
    while from < radii.len() {
        let to = (from..radii.len()).find(|n| radii[*n] < least).unwrap_or(radii.len());
        if to > from && lengths[to - 1] - lengths[from] >= LEAST_LENGTH * radii[from] {
            found.push(from..to);
        }
        from = to + 1;
    }
    found
}

fn move_stretch(voxels: &Voxels, tissue: f64, line: &mut Centerline, radii: &[f64], stretch: Range<usize>) {
    let (points, radii) = (&line.points[stretch.clone()], &radii[stretch.clone()]);
    let lengths = arc_lengths(points);
    let mut places = vec![None; points.len()];
    let mut from = 0;
    while from < points.len() {
        let within = |reach: f64| {
            let first = lengths.partition_point(|length| *length < lengths[from] - MARGIN * radii[from]);
            first..lengths.partition_point(|length| *length <= lengths[from] + reach * radii[from])
        };
        let window = within(PIECE + MARGIN);
        let part = Part { points: &points[window.clone()], radii: &radii[window.clone()] };
        let core = from..within(PIECE).end;
        if let Some(found) = part.on_ridge(voxels, tissue) {
            places[core.clone()].copy_from_slice(&found[core.start - window.start..core.end - window.start]);
        }
        from = core.end;
    }
    let gate = |(place, radius): (&Option<Place>, &f64)| {
        let own = place.filter(|place| place.distance <= OTHER * radius);
        own.map_or(0.0, |place| ((OFF - place.off) / FULL).clamp(0.0, 1.0))
    };
    let gates: Vec<f64> = places.iter().zip(radii).map(gate).collect();
    let shares = spread(&gates, radii, &lengths);
    for ((n, share), place) in stretch.zip(shares).zip(places) {
        if let Some(Place { ridge, distance, .. }) = place.filter(|_| share > 0.0) {
            line.points[n] = line.points[n].lerp(ridge, share);
            line.radius[n] += share * (distance - line.radius[n]).max(0.0);
        }
    }
}

/// The place on the ridge that is nearest to a point.
#[derive(Clone, Copy, Debug)]
struct Place {
    ridge: DVec3,
    /// Distance of the ridge from the wall (mm), and that of the point as a fraction of it.
    distance: f64,
    off: f64,
}

/// Part of a stretch, and the usual radii there (mm).
struct Part<'a> {
    points: &'a [DVec3],
    radii: &'a [f64],
}

impl Part<'_> {
    /// The place on the ridge for each point; None without lumen.
    fn on_ridge(&self, voxels: &Voxels, tissue: f64) -> Option<Vec<Option<Place>>> {
        let Self { points, radii } = *self;
        let map = DistanceMap::around(voxels, &self.spaced(voxels, tissue));
        let path = in_even_steps(&map.ridge([points[0], points[points.len() - 1]])?, STEP * radii[0]);
        let sigma: Vec<f64> =
            path.iter().map(|place| RIDGE_SMOOTHED * radii[nearest_point(points, *place)]).collect();
        let ridge = in_even_steps(&smoothed_by_gaussian(&path, &sigma, false), RIDGE_STEP * radii[0]);
        let place = |point: &DVec3| {
            let ridge = ridge[nearest_point(&ridge, *point)];
            let distance = map.at(ridge);
            Some(Place { ridge, distance, off: map.at(*point) / distance.max(f64::MIN_POSITIVE) })
        };
        Some(points.iter().map(place).collect())
    }

    /// Points a fraction of a radius apart. Their walls are half way between tissue and the lumen around them.
    fn spaced(&self, voxels: &Voxels, tissue: f64) -> Vec<LumenPoint> {
        let lengths = arc_lengths(self.points);
        let values: Vec<f64> = self.points.iter().map(|point| f64::from(voxels.at(*point))).collect();
        let level = |n: usize| {
            let reach = LEVEL_WITHIN * self.radii[n];
            let first = lengths.partition_point(|length| *length < lengths[n] - reach);
            let end = lengths.partition_point(|length| *length <= lengths[n] + reach);
            lower_median(values[first..end].iter().map(|v| if v.is_finite() { *v } else { tissue }).collect())
        };
        let mut next = 0.0;
        let mut chosen = Vec::new();
        for (n, length) in lengths.iter().enumerate() {
            if *length >= next || n + 1 == lengths.len() {
                chosen.push(n);
                next = length + STEP * self.radii[n];
            }
        }
        let point = |n: usize| {
            let wall = f64::midpoint(tissue, level(n));
            LumenPoint { place: self.points[n], radius: self.radii[n], wall }
        };
        chosen.into_iter().map(point).collect()
    }
}

/// The largest value within a radius of each point along the line, smoothed. Both ends stay at 0.
fn spread(gates: &[f64], radii: &[f64], lengths: &[f64]) -> Vec<f64> {
    let within = |n: usize, reach: f64| {
        let first = lengths.partition_point(|length| *length < lengths[n] - reach);
        first..lengths.partition_point(|length| *length <= lengths[n] + reach)
    };
    let count = gates.len();
    let largest: Vec<f64> =
        (0..count).map(|n| gates[within(n, radii[n])].iter().copied().fold(0.0, f64::max)).collect();
    let smooth = |n: usize| {
        let to_end = lengths[n].min(lengths[count - 1] - lengths[n]);
        let sigma = (MOVE_SMOOTHED * radii[n]).max(f64::MIN_POSITIVE);
        let sums = within(n, 3.0 * sigma).fold([0.0, 0.0], |[sum, whole], m| {
            let weight = (-0.5 * ((lengths[m] - lengths[n]) / sigma).powi(2)).exp();
            [sum + weight * largest[m], whole + weight]
        });
        sums[0] / sums[1] * (to_end / radii[n]).min(1.0)
    };
    (0..count).map(smooth).collect()
}

#[cfg(test)]
#[path = "tests/ridge.rs"]
mod tests;
