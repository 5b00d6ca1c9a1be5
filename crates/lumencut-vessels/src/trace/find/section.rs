//! Cross-section of a tube: its level, the walls along rays, and its centre.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::trace::find::pyramid::Level;
use crate::trace::find::quantiles::lower_median;
use lumencut_core::math::lanes::{Isa, Kernel, dispatch};

/// Number of rays; opposite rays form pairs.
const RAYS: usize = 24;

/// Distance between samples of a ray (voxels of the level).
const STEP: f64 = 0.5;

/// Length of a ray: a multiple of the radius plus some voxels.
const REACH_RADII: f64 = 1.6;
const REACH_VOXELS: f64 = 2.0;

/// The wall is at half of a ray's contrast, which must be at least this fraction of the section's contrast.
const LEAST_OF_CONTRAST: f64 = 0.4;

/// Walls are valid between these multiples of the radius, minus a quarter of a voxel and plus half a voxel.
const NEAR_WALL: f64 = 0.55;
const FAR_WALL: f64 = 1.6;

/// Farther walls are moved to this many radii, so that a branch does not shift the centre.
const MAX_WALL_RADII: f64 = 1.5;

/// Rays end at bone only in tubes up to this radius (finest-level voxels).
pub(crate) const TOUCHED: f64 = 3.0;

/// Bone is brighter than lumen by this fraction of the contrast. Rays that meet bone end at the darkest sample before
/// it, because the wall is too thin to resolve. Up to `MOST_BONE` of these rays skip the contrast test.
const ABOVE: f64 = 0.15;
const MOST_BONE: usize = 4;

/// Lengths are in finest-level voxels, values in the unit of the volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Section {
    pub level: f64,
    /// Contrast between lumen and surrounding tissue.
    pub contrast: f64,
    /// Median distance of the walls from the centre.
    pub radius: f64,
    /// Vector from the given position to the centre.
    pub shift: DVec3,
    /// Fraction of rays with a wall about one radius away.
    pub closure: f64,
    /// Fraction of rays that lose at least half of the contrast.
    pub(crate) contrast_share: f64,
}

pub(crate) fn across(direction: DVec3) -> [DVec3; 2] {
    let first = direction.any_orthonormal_vector();
    [first, direction.cross(first)]
}

impl Section {
    pub(crate) fn look(level: &Level, place: DVec3, direction: DVec3, radius: f64) -> Self {
        Walls::seen(level, place, direction, radius).section()
    }

    /// Like `look`, but rays also end at bone, which is brighter than the lumen.
    pub(crate) fn beside_bone(level: &Level, place: DVec3, direction: DVec3, radius: f64) -> Self {
        Walls::seen(level, place, direction, radius).ending_at_bone().section()
    }
}

struct Walls {
    rays: Rays,
    plane: [DVec3; 2],
    /// Approximate radius of the tube, and voxel side of the level (finest-level voxels).
    radius: f64,
    side: f64,
    lumen: f64,
    contrast: f64,
    /// Distance of the wall along each ray, and whether that wall touches bone.
    walls: [f64; RAYS],
    is_bone: [bool; RAYS],
}

impl Walls {
    fn seen(level: &Level, place: DVec3, direction: DVec3, radius: f64) -> Self {
        let plane = across(direction);
        let lumen = lumen(level, place, plane, radius);
        let count = ((REACH_RADII * radius / level.side + REACH_VOXELS) / STEP).ceil() as usize;
        let rays = Rays::cast(level, place, plane, count);
        let mut darkest = rays.darkest;
        let contrast = lumen - lower_median(&mut darkest).unwrap_or(lumen);
        let walls = std::array::from_fn(|n| {
            let own = (lumen - rays.darkest[n]).min(contrast).max(LEAST_OF_CONTRAST * contrast);
            rays.wall(n, lumen, lumen - 0.5 * own)
        });
        Self { rays, plane, radius, side: level.side, lumen, contrast, walls, is_bone: [false; RAYS] }
    }

    fn usual(&self) -> f64 {
        lower_median(&mut self.walls.clone()).unwrap_or(0.0)
    }

    fn counted(&self) -> [f64; 2] {
        let usual = self.usual();
        [NEAR_WALL * usual - 0.25 * self.side, FAR_WALL * usual + 0.5 * self.side]
    }

    /// Rays without a valid wall end at bone, if they meet any.
    fn ending_at_bone(mut self) -> Self {
        let [_, far] = self.counted();
        let above = self.lumen + ABOVE * self.contrast;
        for n in (0..RAYS).filter(|n| self.walls[*n] > far).collect::<Vec<_>>() {
            if let Some(wall) = self.rays.wall_at_bone(n, above).filter(|wall| *wall < self.walls[n]) {
                (self.walls[n], self.is_bone[n]) = (wall, true);
            }
        }
        self
    }

    fn section(&self) -> Section {
        let (found, [near, far]) = (self.usual(), self.counted());
        let count = |holds: &dyn Fn(usize) -> bool| (0..RAYS).filter(|n| holds(*n)).count() as f64;
        let wall = |n: usize| self.walls[n];
        let loses = |n: usize| !self.is_bone[n] && self.lumen - self.rays.darkest[n] >= 0.5 * self.contrast;
        let free_rays = RAYS - self.is_bone.iter().filter(|is| **is).count().min(MOST_BONE);
        Section {
            level: self.lumen,
            contrast: self.contrast,
            radius: found,
            shift: shift(&self.walls.map(|wall| wall.min(MAX_WALL_RADII * found)), self.plane, self.radius),
            closure: count(&|n| wall(n) >= near && wall(n) <= far && wall(n) < self.rays.reach) / RAYS as f64,
            contrast_share: count(&loses) / free_rays as f64,
        }
    }
}

fn lumen(level: &Level, place: DVec3, plane: [DVec3; 2], radius: f64) -> f64 {
    let mut values = [f64::from(level.at(place)); 13];
    for n in 0..12 {
        let (sin, cos) = (TAU * n as f64 / 6.0).sin_cos();
        let length = if n < 6 { 0.5 } else { 0.25 } * radius;
        values[n + 1] = f64::from(level.at(place + (plane[0] * cos + plane[1] * sin) * length));
    }
    lower_median(&mut values).unwrap_or(values[0])
}

struct Rays {
    /// Values of all rays by step; each row has one value per ray.
    values: Vec<[f32; RAYS]>,
    /// Distance between samples, and length of the rays (finest-level voxels).
    step: f64,
    reach: f64,
    darkest: [f64; RAYS],
}

impl Rays {
    fn cast(level: &Level, place: DVec3, plane: [DVec3; 2], count: usize) -> Self {
        let mut strides = [[0.0; RAYS]; 3];
        for n in 0..RAYS {
            let (sin, cos) = (TAU * n as f64 / RAYS as f64).sin_cos();
            let ray = (plane[0] * cos + plane[1] * sin) * STEP;
            for a in 0..3 {
                strides[a][n] = ray[a] as f32;
            }
        }
        let start = (place / level.side).to_array().map(|c| c as f32);
        let values = dispatch(Isa::widest(), Sampled { level, start, strides, count });
        let mut darkest = [f32::MAX; RAYS];
        for row in &values {
            for n in 0..RAYS {
                darkest[n] = if row[n] < darkest[n] { row[n] } else { darkest[n] };
            }
        }
        let step = STEP * level.side;
        Self { values, step, reach: step * count as f64, darkest: darkest.map(f64::from) }
    }

    /// Distance at which a ray first falls below a value; the length of the ray if it never does.
    fn wall(&self, ray: usize, start: f64, below: f64) -> f64 {
        let is_below = |row: &[f32; RAYS]| f64::from(row[ray]) < below;
        let Some(n) = self.values.iter().position(is_below) else { return self.reach };
        let before = if n == 0 { start } else { f64::from(self.values[n - 1][ray]) };
        let drop = before - f64::from(self.values[n][ray]);
        let share = if drop > 0.0 { ((before - below) / drop).clamp(0.0, 1.0) } else { 0.0 };
        (n as f64 + share) * self.step
    }

    /// Distance of the darkest sample before a ray first rises above a value; None if it never rises.
    fn wall_at_bone(&self, ray: usize, above: f64) -> Option<f64> {
        let value = |n: &usize| self.values[*n][ray];
        let bone = (0..self.values.len()).find(|n| f64::from(value(n)) > above)?;
        // Of equally dark samples the last one is taken, so that without a wall the ray ends at bone.
        let darkest = (bone / 2..bone).rev().min_by(|a, b| value(a).total_cmp(&value(b))).unwrap_or(bone);
        Some((darkest + 1) as f64 * self.step)
    }
}

struct Sampled<'a> {
    level: &'a Level,
    /// Start of the rays, in voxels of the level.
    start: [f32; 3],
    strides: [[f32; RAYS]; 3],
    count: usize,
}

impl Kernel for Sampled<'_> {
    type Output = Vec<[f32; RAYS]>;

    #[inline(always)]
    fn run(self) -> Vec<[f32; RAYS]> {
        (1..=self.count)
            .map(|m| {
                let mut places = [[0.0_f32; RAYS]; 3];
                for a in 0..3 {
                    for n in 0..RAYS {
                        places[a][n] = self.start[a] + self.strides[a][n] * m as f32;
                    }
                }
                self.level.at_lanes(&places)
            })
            .collect()
    }
}

/// Shift of the centre: the mean difference between opposite walls, at most half a radius.
fn shift(walls: &[f64; RAYS], plane: [DVec3; 2], radius: f64) -> DVec3 {
    let pairs = RAYS / 2;
    let mut sum = DVec3::ZERO;
    for n in 0..pairs {
        let (sin, cos) = (TAU * n as f64 / RAYS as f64).sin_cos();
        sum += (plane[0] * cos + plane[1] * sin) * (walls[n] - walls[n + pairs]);
    }
    // Averaged over a half circle, the differences are half of the shift.
    (sum / pairs as f64).clamp_length_max(0.5 * radius)
}

#[cfg(test)]
#[path = "tests/section.rs"]
mod tests;
