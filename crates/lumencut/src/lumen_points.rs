//! Which points of centerlines look like lumen in a volume, whatever its units and whether lumen is bright or dark in it.

use std::collections::BTreeSet;

use glam::DVec3;
use lumencut_core::volume::Volume;

use crate::extent::Extent;
use crate::places::Place;
use crate::windows::sample;
use lumencut_core::math::statistics::median;

/// Points are looked at once for each cube of this side (mm): points that lie closely say the same thing twice.
const CUBE: f64 = 2.0;
/// The most points that are looked at.
const MOST_POINTS: usize = 2000;
/// The fewest points that look like lumen where they decide anything: of cubes of 2 mm, some 40 mm of vessel.
const FEWEST: usize = 20;
/// How many times as many points one reading must have as the other.
const TIMES: usize = 3;
/// How far around a point its own value is taken, and how far away its surroundings are, where no radius is known (mm).
const UNKNOWN: (f64, f64) = (1.0, 15.0);
/// How far beyond the wall the surroundings are at least (mm); else a radius beyond it.
const BESIDE: f64 = 3.0;

/// Points of centerlines with their radii, NaN where one is not known, both as they stand in a file.
#[derive(Clone, Copy, Debug)]
pub struct Lines<'a> {
    /// The points.
    pub points: &'a [DVec3],
    /// The radius at each point.
    pub radii: &'a [f64],
}

/// How many points look like lumen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LumenCount {
    /// Those that are brighter than their surroundings, or those that are darker, whichever are more.
    pub(crate) like_lumen: usize,
    /// How many were looked at.
    pub of: usize,
}

/// What the volume can say.
#[derive(Clone, Copy)]
pub struct Judge<'a> {
    /// The space that it fills.
    pub extent: Extent,
    /// How many points look like lumen in it where they are read in a place.
    pub lumen: &'a dyn Fn(Place) -> LumenCount,
}

impl LumenCount {
    /// Whether these points are lumen and those of the other reading are not: at least three times as many look like it,
    /// at least half of all, and at least twenty.
    pub(crate) fn is_evident_beside(self, other: Self) -> bool {
        self.like_lumen >= FEWEST
            && 2 * self.like_lumen >= self.of
            && self.like_lumen >= TIMES * other.like_lumen
    }
}

/// Counts the points that look like lumen where the lines are read in a place.
///
/// A point does where its own value, the median of it and of six points half a radius around it, is above three quarters
/// of the values of 26 points around it, a radius beyond the wall. Ranks alone count: so it is the same for CT, MR and
/// bytes. Where more points are below three quarters of their surroundings, as in volumes with dark lumens, those count.
pub fn lumen_count(volume: &Volume, lines: &Lines, place: Place) -> LumenCount {
    let (scale, mm) = (place.scale(), place.unit.in_mm());
    let looked_at = spread(lines, mm);
    let (mut brighter, mut darker) = (0, 0);
    for n in &looked_at {
        let (point, radius) = (lines.points[*n] * scale, lines.radii[*n] * mm);
        let is_known = radius > 0.0;
        let (own, away) = if is_known { (0.5 * radius, radius + radius.max(BESIDE)) } else { UNKNOWN };
        if let Some((below, above, all)) = ranks(volume, point, own, away) {
            brighter += usize::from(4 * below >= 3 * all);
            darker += usize::from(4 * above >= 3 * all);
        }
    }
    LumenCount { like_lumen: brighter.max(darker), of: looked_at.len() }
}

/// One point for each cube of space, evenly thinned to [`MOST_POINTS`].
fn spread(lines: &Lines, mm: f64) -> Vec<usize> {
    let mut cubes = BTreeSet::new();
    let cube = |point: DVec3| (point * mm / CUBE).floor().as_i64vec3().to_array();
    let kept: Vec<usize> = (0..lines.points.len()).filter(|n| cubes.insert(cube(lines.points[*n]))).collect();
    kept.iter().copied().step_by(kept.len().div_ceil(MOST_POINTS).max(1)).collect()
}

/// How many of the values `away` from a point are below its own, how many above, and how many there are. None where the
/// point or most of its surroundings are outside the volume.
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

/// The directions from the middle of a cube to its corners, edges and faces.
fn directions() -> Vec<DVec3> {
    let step = |n: u32| DVec3::new(f64::from(n % 3), f64::from(n / 3 % 3), f64::from(n / 9)) - 1.0;
    (0..27).map(step).filter(|step| *step != DVec3::ZERO).map(DVec3::normalize).collect()
}

#[cfg(test)]
#[path = "tests/lumen_points.rs"]
mod tests;
