//! The clamped volume at several resolutions, so that every vessel is a few voxels wide at one of them.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::grid::Grid;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::math::lanes::{FAN, larger, smaller};
use lumencut_core::stop::{Stop, go_on};

/// Halving of the resolution stops when the widest vessel (mm) is this many voxels wide, or at the minimum size.
const VOXELS_OF_WIDEST: f64 = 3.2;
const WIDEST: f64 = 18.0;
const LEAST_SIZE: usize = 10;

/// Weights of a Gaussian with a standard deviation of 0.8 voxels.
const HALVING: [f32; 3] = [0.495_4, 0.226_7, 0.025_6];

/// The largest number that is stored.
const FULL: f32 = 65_535.0;

#[derive(Clone, Debug)]
pub(crate) struct Level {
    pub size: [usize; 3],
    /// Side of a voxel, in finest-level voxels.
    pub side: f64,
    /// Values scaled to 0 to 65535 over the value range; the first axis varies fastest.
    pub voxels: Vec<u16>,
    /// The value that the number 0 stands for, and the value of a step of 1, in the unit of the volume.
    pub lowest: f32,
    pub unit: f32,
}

#[derive(Debug)]
pub(crate) struct Pyramid {
    pub grid: Grid,
    pub levels: Vec<Level>,
}

impl Level {
    /// Trilinear value at a position of the finest grid, clamped at the edge.
    #[inline]
    pub(crate) fn at(&self, place: DVec3) -> f32 {
        let scale = 1.0 / self.side;
        let (mut first, mut share) = ([0_usize; 3], [0.0_f32; 3]);
        for a in 0..3 {
            let last = (self.size[a] - 1) as f64;
            let along = (place[a] * scale).clamp(0.0, last);
            let low = (along as usize).min(self.size[a].saturating_sub(2));
            (first[a], share[a]) = (low, (along - low as f64) as f32);
        }
        let [sj, sk] = [self.size[0], self.size[0] * self.size[1]];
        let base = first[0] + first[1] * sj + first[2] * sk;
        let di = usize::from(self.size[0] > 1);
        let [dj, dk] = [if self.size[1] > 1 { sj } else { 0 }, if self.size[2] > 1 { sk } else { 0 }];
        let value = |offset: usize| f32::from(self.voxels[base + offset]);
        let line = |offset: usize| {
            let (a, b) = (value(offset), value(offset + di));
            a + (b - a) * share[0]
        };
        let plane = |offset: usize| {
            let (a, b) = (line(offset), line(offset + dj));
            a + (b - a) * share[1]
        };
        let (a, b) = (plane(0), plane(dk));
        self.lowest + self.unit * (a + (b - a) * share[2])
    }

    /// Trilinear values at positions of this level, clamped at the edge.
    #[inline(always)]
    pub(crate) fn at_lanes<const N: usize>(&self, places: &[[f32; N]; 3]) -> [f32; N] {
        let (mut first, mut share) = ([0_u32; N], [[0.0_f32; N]; 3]);
        let strides = [1, self.size[0], self.size[0] * self.size[1]];
        for a in 0..3 {
            let last = (self.size[a] - 1) as f32;
            // If an axis has only one voxel, that voxel is used twice (`steps`).
            let most = last.max(1.0) - 1.0;
            for n in 0..N {
                let along = larger(smaller(places[a][n], last), 0.0);
                let low = smaller(along.floor(), most);
                share[a][n] = along - low;
                first[n] += low as u32 * strides[a] as u32;
            }
        }
        let steps: [usize; 3] = std::array::from_fn(|a| if self.size[a] > 1 { strides[a] } else { 0 });
        let line = |offset: usize| -> [f32; N] {
            let mut values = [[0.0_f32; N]; 2];
            for n in 0..N {
                let place = first[n] as usize + offset;
                values[0][n] = f32::from(self.voxels[place]);
                values[1][n] = f32::from(self.voxels[place + steps[0]]);
            }
            between(&values[0], &values[1], &share[0])
        };
        let near = between(&line(0), &line(steps[1]), &share[1]);
        let far = between(&line(steps[2]), &line(steps[1] + steps[2]), &share[1]);
        let mut made = between(&near, &far, &share[2]);
        for value in &mut made {
            *value = self.lowest + self.unit * *value;
        }
        made
    }

    fn clamp(&mut self, ends: [f64; 2]) {
        let [least, most] = ends.map(|end| ((end as f32 - self.lowest) / self.unit).clamp(0.0, FULL) as u16);
        self.voxels.par_iter_mut().for_each(|voxel| *voxel = (*voxel).max(least).min(most));
    }

    fn halved(&self) -> Self {
        let [nx, ny, nz] = self.size;
        let [mx, my, mz] = self.size.map(|n| n.div_ceil(2));
        let mut flat = vec![0_u16; mx * my * nz];
        flat.par_chunks_mut(mx * my).enumerate().for_each(|(k, slice)| {
            let source = &self.voxels[k * nx * ny..][..nx * ny];
            let mut rows = vec![0.0_f32; nx];
            for (j, out) in slice.chunks_mut(mx).enumerate() {
                let taken = taps(2 * j, ny);
                rows.fill(0.0);
                for (weight, y) in taken {
                    for (sum, value) in rows.iter_mut().zip(&source[y * nx..][..nx]) {
                        *sum += weight * f32::from(*value);
                    }
                }
                for (i, value) in out.iter_mut().enumerate() {
                    let sum: f32 = taps(2 * i, nx).iter().map(|(weight, x)| weight * rows[*x]).sum();
                    *value = (sum + 0.5) as u16;
                }
            }
        });
        let mut voxels = vec![0_u16; mx * my * mz];
        voxels.par_chunks_mut(mx * my).enumerate().for_each(|(k, slice)| {
            let taken = taps(2 * k, nz).map(|(weight, z)| (weight, &flat[z * mx * my..][..mx * my]));
            for (n, value) in slice.iter_mut().enumerate() {
                let sum: f32 = taken.iter().map(|(weight, plane)| weight * f32::from(plane[n])).sum();
                *value = (sum + 0.5) as u16;
            }
        });
        Self { size: [mx, my, mz], side: 2.0 * self.side, voxels, lowest: self.lowest, unit: self.unit }
    }
}

#[inline(always)]
fn between<const N: usize>(from: &[f32; N], to: &[f32; N], share: &[f32; N]) -> [f32; N] {
    let mut made = [0.0; N];
    for n in 0..N {
        made[n] = from[n] + (to[n] - from[n]) * share[n];
    }
    made
}

fn taps(center: usize, count: usize) -> [(f32, usize); 5] {
    let at = |shift: isize| center.saturating_add_signed(shift).min(count - 1);
    [
        (HALVING[2], at(-2)),
        (HALVING[1], at(-1)),
        (HALVING[0], at(0)),
        (HALVING[1], at(1)),
        (HALVING[2], at(2)),
    ]
}

impl Pyramid {
    pub(crate) fn new(voxels: &Voxels, grid: Grid, range: [f64; 2], stop: Stop) -> Result<Self> {
        let finest = finest(voxels, &grid, range, stop)?;
        let mut pyramid = Self { grid, levels: vec![finest] };
        pyramid.halve(stop)?;
        Ok(pyramid)
    }

    /// Limits the values to a range.
    pub(crate) fn clamp(&mut self, ends: [f64; 2], stop: Stop) -> Result<()> {
        self.levels.truncate(1);
        self.levels[0].clamp(ends);
        self.halve(stop)
    }

    fn halve(&mut self, stop: Stop) -> Result<()> {
        loop {
            go_on(stop)?;
            let last = &self.levels[self.levels.len() - 1];
            let is_wide = VOXELS_OF_WIDEST * self.grid.side * 2.0 * last.side >= WIDEST;
            if is_wide || last.size.iter().any(|n| n.div_ceil(2) < LEAST_SIZE) {
                return Ok(());
            }
            let next = last.halved();
            self.levels.push(next);
        }
    }

    /// The level for a tube of a radius (finest-level voxels): the finest on which the radius is below four voxels.
    pub(crate) fn level_for(&self, radius: f64, levels_examined: &Range<usize>) -> &Level {
        let last = levels_examined.end - 1;
        let number = (levels_examined.start..last)
            .find(|n| radius < NEXT_LEVEL_RADIUS * self.levels[*n].side)
            .unwrap_or(last);
        &self.levels[number]
    }

    pub(crate) fn all(&self) -> Range<usize> {
        0..self.levels.len()
    }
}

/// Tubes from this radius (voxels) on are examined on the next coarser level.
const NEXT_LEVEL_RADIUS: f64 = 4.0;

/// Resamples the volume; NaN becomes the lowest value.
fn finest(voxels: &Voxels, grid: &Grid, [lowest, highest]: [f64; 2], stop: Stop) -> Result<Level> {
    let [nx, ny, nz] = grid.size;
    let unit = ((highest - lowest) as f32 / FULL).max(f32::MIN_POSITIVE);
    let index_from_grid = voxels.index_from_world * grid.world_from_grid;
    let (stride, lowest) = (index_from_grid.matrix3.x_axis, lowest as f32);
    let mut made = vec![0_u16; nx * ny * nz];
    made.par_chunks_mut(nx).enumerate().try_for_each(|(row, values)| {
        if row % 64 == 0 {
            go_on(stop)?;
        }
        let start = index_from_grid.transform_point3(DVec3::new(0.0, (row % ny) as f64, (row / ny) as f64));
        let mut samples = Vec::with_capacity(nx + FAN);
        while samples.len() < nx {
            voxels.along(start, stride, &mut samples);
        }
        for (value, sample) in values.iter_mut().zip(&samples) {
            // The cast turns NaN into 0.
            *value = ((sample - lowest) / unit).round() as u16;
        }
        Ok(())
    })?;
    Ok(Level { size: grid.size, side: 1.0, voxels: made, lowest, unit })
}

#[cfg(test)]
#[path = "tests/pyramid.rs"]
mod tests;
