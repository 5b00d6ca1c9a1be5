//! Counts the centerline points that look like lumen. This works for values in any unit, and for bright or dark lumen.

use std::collections::BTreeSet;

use glam::DVec3;
use lumencut_core::volume::Volume;

use crate::extent::Extent;
use crate::places::CoordinateSystem;
use crate::windows::sample;
use lumencut_core::math::statistics::median;

/// One point is sampled in each cube of this side (mm), since close points carry the same information.
const CUBE_MM: f64 = 2.0;
const MAX_POINTS: usize = 2000;
/// At least this many points must look like lumen: about 40 mm of vessel in cubes of 2 mm.
const MIN_LUMEN_POINTS: usize = 20;
/// A reading wins only if at least this many times as many points look like lumen as in the other reading.
const MIN_RATIO: usize = 3;
/// If no radius is known (mm): distance of the six values that belong to a point, and distance of its surroundings.
const UNKNOWN_RADIUS: (f64, f64) = (1.0, 15.0);
/// The surroundings are sampled one radius beyond the wall, but at least this far (mm).
const MIN_SURROUNDINGS_MM: f64 = 3.0;

/// Points and radii of centerlines as in their file; NaN for unknown radii.
#[derive(Clone, Copy, Debug)]
pub struct Lines<'a> {
    /// The points.
    pub points: &'a [DVec3],
    /// The radius at each point.
    pub radii: &'a [f64],
}

/// How many of the sampled points look like lumen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LumenCount {
    /// The number of points brighter than their surroundings or of darker ones, whichever is larger.
    pub(crate) like_lumen: usize,
    /// The number of sampled points.
    pub of: usize,
}

/// The data of a volume that decide about space and unit of centerlines.
#[derive(Clone, Copy)]
pub struct Judge<'a> {
    /// The extent of the volume.
    pub extent: Extent,
    /// Counts the points that look like lumen if the lines are read in this space and unit.
    pub lumen: &'a dyn Fn(CoordinateSystem) -> LumenCount,
}

impl LumenCount {
    /// Whether the points of this reading are lumen and those of the other reading are not. At least twenty points, half of all
    /// points, and three times as many as in the other reading must look like lumen.
    pub(crate) fn is_evident_over(self, other: Self) -> bool {
        self.like_lumen >= MIN_LUMEN_POINTS
            && 2 * self.like_lumen >= self.of
            && self.like_lumen >= MIN_RATIO * other.like_lumen
    }
}

/// Counts the points that look like lumen if the lines are read in a space and unit.
///
/// The value of a point is the median of the voxel there and six points half a radius away. It looks like lumen if it exceeds three
/// quarters of 26 values around it, a radius beyond the wall. Only ranks matter, so the result does not depend on the modality or
/// on scaling. If more points are darker than three quarters of their surroundings, the lumen is dark and those points count.
pub fn lumen_count(volume: &Volume, lines: &Lines, place: CoordinateSystem) -> LumenCount {
    let (scale, mm) = (place.scale(), place.unit.in_mm());
    let looked_at = spread(lines, mm);
    let (mut brighter, mut darker) = (0, 0);
    for n in &looked_at {
        let (point, radius) = (lines.points[*n] * scale, lines.radii[*n] * mm);
        let is_known = radius > 0.0;
        let (own, away) =
            if is_known { (0.5 * radius, radius + radius.max(MIN_SURROUNDINGS_MM)) } else { UNKNOWN_RADIUS };
        if let Some((below, above, all)) = ranks(volume, point, own, away) {
            brighter += usize::from(4 * below >= 3 * all);
            darker += usize::from(4 * above >= 3 * all);
        }
    }
    LumenCount { like_lumen: brighter.max(darker), of: looked_at.len() }
}

/// One point per cube; if there are more than [`MAX_POINTS`], an even selection.
fn spread(lines: &Lines, mm: f64) -> Vec<usize> {
    let mut cubes = BTreeSet::new();
    let cube = |point: DVec3| (point * mm / CUBE_MM).floor().as_i64vec3().to_array();
    let kept: Vec<usize> = (0..lines.points.len()).filter(|n| cubes.insert(cube(lines.points[*n]))).collect();
    kept.iter().copied().step_by(kept.len().div_ceil(MAX_POINTS).max(1)).collect()
}

/// How many of the values `away` mm from a point are below and above the point's own value, and how many there are. None if the
/// point or most of its surroundings lie outside the volume.
fn ranks(volume: &Volume, point: DVec3, own: f64, away: f64) -> Option<(usize, usize, usize)> {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
    let near: Vec<DVec3> = std::iter::once(point).chain(sides.map(|side| point + own * side)).collect();
    let near = sample(volume, &near);
    if near[0].is_nan() {
        return None;
    }
    let value = median(&mut numbers(&near))?;
    let directions = directions();
    let around: Vec<DVec3> = directions.iter().map(|direction| point + away * *direction).collect();
    let around = numbers(&sample(volume, &around));
    let below = around.iter().filter(|one| **one < value).count();
    let above = around.iter().filter(|one| **one > value).count();
    (2 * around.len() > directions.len()).then_some((below, above, around.len()))
}

fn numbers(values: &[f32]) -> Vec<f64> {
    values.iter().filter(|value| !value.is_nan()).map(|value| f64::from(*value)).collect()
}

fn directions() -> Vec<DVec3> {
    let step = |n: u32| DVec3::new(f64::from(n % 3), f64::from(n / 3 % 3), f64::from(n / 9)) - 1.0;
    (0..27).map(step).filter(|step| *step != DVec3::ZERO).map(DVec3::normalize).collect()
}

#[cfg(test)]
#[path = "tests/lumen_points.rs"]
mod tests;
