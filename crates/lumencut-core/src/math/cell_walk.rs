//! Follows rays through the volume cell by cell. Within a cell the interpolated volume along a ray is a
//! cubic, so the largest value and the mean are exact, not sampled.

use super::cubic::{Corners, Cubic, Weights};
use super::lanes::{FAN, Kernel, larger, smaller};
use super::ray::RaySpan;
use super::sampling::{Grid, Offset};
use crate::volume::{Real, Voxel};

/// Stands for the place of a plane that a ray never reaches, as a share of the ray's segment: far beyond its end.
pub const NO_MEETING: f32 = 1e9;
/// A ray that moves by less than this along an axis (voxels) counts as parallel to that axis's planes.
pub const ALONG_PLANE: f32 = 1e-9;

pub(crate) trait Fold<R> {
    /// Whether cells with a largest corner value of `top` can change the result; `length` is as in `take`.
    fn asks(&self, top: &[f32; FAN], length: &[f32; FAN]) -> bool;
    /// Takes a cubic per ray: `top` is its largest corner value, `length` (mm) is 0 after the ray's end.
    fn take(&mut self, cubic: &Cubic<R, FAN>, top: &[f32; FAN], length: &[f32; FAN]);
}

#[derive(Debug)]
pub(crate) struct Largest<'a> {
    /// The largest value of each ray so far; HUGE for rays that need no value.
    pub best: &'a mut [f32; FAN],
    /// Values above this count as equal to it.
    pub limit: f32,
}

impl<R: Real> Fold<R> for Largest<'_> {
    #[inline(always)]
    fn asks(&self, top: &[f32; FAN], length: &[f32; FAN]) -> bool {
        let mut asks = 0;
        for l in 0..FAN {
            asks |= u32::from((length[l] > 0.0) & (smaller(top[l], self.limit) > self.best[l]));
        }
        asks != 0
    }

    #[inline(always)]
    fn take(&mut self, cubic: &Cubic<R, FAN>, top: &[f32; FAN], length: &[f32; FAN]) {
        self.widen(&cubic.largest_end(), top, length);
        // Most cubics stay below the largest value so far and need no search for a local maximum.
        let (bound, mut rises) = (cubic.bound(), 0);
        for l in 0..FAN {
            let bound = smaller(bound[l].to_f32(), self.limit);
            rises |= u32::from((length[l] > 0.0) & (bound > self.best[l]));
        }
        if rises != 0 {
            self.widen(&cubic.at_summit(), top, length);
        }
    }
}

impl Largest<'_> {
    #[inline(always)]
    fn widen<R: Real>(&mut self, value: &[R; FAN], top: &[f32; FAN], length: &[f32; FAN]) {
        for l in 0..FAN {
            let value = value[l].to_f32();
            // Interpolation never exceeds the largest corner, but rounding can.
            let value = if value > top[l] { top[l] } else { value };
            let value = if value > self.limit { self.limit } else { value };
            let is_larger = (length[l] > 0.0) & (value > self.best[l]);
            self.best[l] = if is_larger { value } else { self.best[l] };
        }
    }
}

/// Σ value · length (mm), and Σ length.
#[derive(Debug)]
pub(crate) struct Sums<'a>(pub &'a mut [[f64; FAN]; 2]);

impl<R: Real> Fold<R> for Sums<'_> {
    #[inline(always)]
    fn asks(&self, _: &[f32; FAN], length: &[f32; FAN]) -> bool {
        let mut asks = 0;
        for l in 0..FAN {
            asks |= u32::from(length[l] > 0.0);
        }
        asks != 0
    }

    #[inline(always)]
    fn take(&mut self, cubic: &Cubic<R, FAN>, _: &[f32; FAN], length: &[f32; FAN]) {
        let mean = cubic.mean();
        for l in 0..FAN {
            let mean = mean[l].to_f32();
            let length = if mean.is_nan() { 0.0 } else { f64::from(length[l]) };
            let mean = if mean.is_nan() { 0.0 } else { f64::from(mean) };
            self.0[0][l] += mean * length;
            self.0[1][l] += length;
        }
    }
}

/// A walk through the cells along `stretch`; the values of voxels are multiplied by `sign`.
pub(crate) struct CellWalk<'a, T, F> {
    pub grid: &'a Grid,
    pub voxels: &'a [T],
    pub base: [i32; 3],
    /// The positions of the rays, relative to `base`.
    pub stretch: &'a RaySpan,
    /// −1 turns the search for the largest value into one for the smallest.
    pub sign: f32,
    pub fold: F,
}

impl<T: Voxel, F: Fold<T::Real>> Kernel for CellWalk<'_, T, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        if self.grid.is_wide() { self.walk::<usize>() } else { self.walk::<u32>() }
    }
}

struct Walkers {
    /// Each ray's cell, axis by axis: −1 before the first voxel centre, the last index beyond the last centre.
    cell: [[i32; FAN]; 3],
    /// The next plane, and the share of the ray's segment per voxel across planes; 0 for a ray parallel to them.
    plane: [[f32; FAN]; 3],
    per_voxel: [[f32; FAN]; 3],
    gone: [f32; FAN],
}

impl Walkers {
    #[inline(always)]
    fn new(stretch: &RaySpan) -> Self {
        let mut walkers = Self {
            cell: [[0; FAN]; 3],
            plane: [[0.0; FAN]; 3],
            per_voxel: [[0.0; FAN]; 3],
            gone: [0.0; FAN],
        };
        for a in 0..3 {
            for l in 0..FAN {
                let (start, way) = (stretch.start[a][l], stretch.way[a][l]);
                // This rounds down, because `start` is at least −0.5.
                let cell = (start + 1.0) as i32 - 1;
                walkers.cell[a][l] = cell;
                walkers.plane[a][l] = (cell + i32::from(way > 0.0)) as f32;
                let is_parallel = way.abs() < ALONG_PLANE;
                let per_voxel = 1.0 / if is_parallel { 1.0 } else { way };
                walkers.per_voxel[a][l] = if is_parallel { 0.0 } else { per_voxel };
            }
        }
        walkers
    }

    #[inline(always)]
    fn meeting(&self, stretch: &RaySpan, a: usize) -> [f32; FAN] {
        let mut meeting = [NO_MEETING; FAN];
        for l in 0..FAN {
            let share = (self.plane[a][l] - stretch.start[a][l]) * self.per_voxel[a][l];
            meeting[l] = if self.per_voxel[a][l] == 0.0 { NO_MEETING } else { share };
        }
        meeting
    }
}

/// Number of cells that each ray finds before it reads the voxels of the first of them.
const CELLS_AHEAD: usize = 2;

#[derive(Clone, Copy)]
struct Passed {
    cell: [[f32; FAN]; 3],
    enter: [f32; FAN],
    leave: [f32; FAN],
}

impl<T: Voxel, F: Fold<T::Real>> CellWalk<'_, T, F> {
    #[inline(always)]
    fn walk<O: Offset>(mut self) {
        let mut walkers = Walkers::new(self.stretch);
        let voxels = &self.voxels[self.grid.offset_of(self.base)..];
        let nowhere = Passed { cell: [[0.0; FAN]; 3], enter: [0.0; FAN], leave: [0.0; FAN] };
        loop {
            let (mut passed, mut offset) = ([nowhere; CELLS_AHEAD], [[O::default(); FAN]; CELLS_AHEAD]);
            for n in 0..CELLS_AHEAD {
                passed[n] = self.go_on(&mut walkers, &mut offset[n]);
            }
            let rows = self.grid.rows(voxels, &offset);
            for n in 0..CELLS_AHEAD {
                self.pass(&passed[n], [&rows[0][n], &rows[1][n], &rows[2][n], &rows[3][n]]);
            }
            let mut goes_on = 0;
            for l in 0..FAN {
                goes_on |= u32::from(walkers.gone[l] < self.stretch.end[l]);
            }
            if goes_on == 0 {
                return;
            }
        }
    }

    #[inline(always)]
    fn go_on<O: Offset>(&self, walkers: &mut Walkers, offset: &mut [O; FAN]) -> Passed {
        let stretch = self.stretch;
        let meetings =
            [walkers.meeting(stretch, 0), walkers.meeting(stretch, 1), walkers.meeting(stretch, 2)];
        let mut passed = Passed { cell: [[0.0; FAN]; 3], enter: walkers.gone, leave: stretch.end };
        for meeting in &meetings {
            for l in 0..FAN {
                passed.leave[l] = smaller(passed.leave[l], meeting[l]);
            }
        }
        self.step(0, &meetings[0], walkers, &mut passed, offset);
        self.step(1, &meetings[1], walkers, &mut passed, offset);
        self.step(2, &meetings[2], walkers, &mut passed, offset);
        walkers.gone = passed.leave;
        passed
    }

    #[inline(always)]
    fn step<O: Offset>(
        &self,
        a: usize,
        meeting: &[f32; FAN],
        walkers: &mut Walkers,
        passed: &mut Passed,
        offset: &mut [O; FAN],
    ) {
        let (low, stride) = (self.grid.last_cell()[a] - self.base[a], O::stride(self.grid, a));
        let (cell, plane, per_voxel) = (&mut walkers.cell[a], &mut walkers.plane[a], &walkers.per_voxel[a]);
        for l in 0..FAN {
            let inside = cell[l].max(0).min(low);
            passed.cell[a][l] = inside as f32;
            offset[l] = offset[l].plus(inside, stride);
            let step = if per_voxel[l] > 0.0 { 1 } else { -1 };
            let is_crossed = (meeting[l] <= passed.leave[l]) & (passed.leave[l] < self.stretch.end[l]);
            let step = if is_crossed { step } else { 0 };
            cell[l] += step;
            plane[l] += step as f32;
        }
    }

    #[inline(always)]
    fn pass(&mut self, passed: &Passed, rows: [&[T::Pair; FAN]; 4]) {
        let mut length = [0.0; FAN];
        for l in 0..FAN {
            length[l] = larger(passed.leave[l] - passed.enter[l], 0.0) * self.stretch.length[l];
        }
        let sign = T::Real::from_f32(self.sign);
        let mut corners: Corners<T::Real, FAN> = [[sign; FAN]; 8];
        for r in 0..4 {
            let row = *rows[r];
            for l in 0..FAN {
                corners[2 * r][l] = T::ends(row[l]).0 * sign;
            }
            for l in 0..FAN {
                corners[2 * r + 1][l] = T::ends(row[l]).1 * sign;
            }
        }
        let (mut largest, mut top) = (corners[0], [0.0; FAN]);
        for corner in &corners[1..] {
            for l in 0..FAN {
                largest[l] = larger(largest[l], corner[l]);
            }
        }
        for l in 0..FAN {
            top[l] = largest[l].to_f32();
        }
        if !self.fold.asks(&top, &length) {
            return;
        }
        let enter = self.weights(&passed.cell, &passed.enter);
        let cubic = Cubic::between(&corners, &enter, &self.weights(&passed.cell, &passed.leave));
        self.fold.take(&cubic, &top, &length);
    }

    #[inline(always)]
    fn weights(&self, cell: &[[f32; FAN]; 3], gone: &[f32; FAN]) -> Weights<T::Real, FAN> {
        // A loop over the axes would make the compiler vectorise over them instead of over the rays.
        [
            self.weights_along(0, cell, gone),
            self.weights_along(1, cell, gone),
            self.weights_along(2, cell, gone),
        ]
    }

    #[inline(always)]
    fn weights_along(&self, a: usize, cell: &[[f32; FAN]; 3], gone: &[f32; FAN]) -> [T::Real; FAN] {
        let (start, way, cell) = (&self.stretch.start[a], &self.stretch.way[a], &cell[a]);
        let mut weights = [T::Real::from_f32(0.0); FAN];
        for l in 0..FAN {
            let place = start[l] + way[l] * gone[l] - cell[l];
            weights[l] = T::Real::from_f32(smaller(larger(place, 0.0), 1.0));
        }
        weights
    }
}
