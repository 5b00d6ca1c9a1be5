//! A volume of any voxel type behind one interface.

use super::cell_walk::{CellWalk, Largest, Sums};
use super::lanes::{FAN, Isa, Kernel, dispatch};
use super::ray::{Line, RaySpan, STEPS};
use super::sampling::{Around, Grid, SampledRun};
use crate::volume::Voxel;

/// A volume of any voxel type on a chosen instruction set, so that ray code compiles only once.
pub(crate) trait Sampler: Sync {
    fn along(&self, base: [i32; 3], line: &Line) -> [[f32; FAN]; STEPS];
    fn around(&self, base: [i32; 3], neighbours: &Around) -> [[f32; FAN]; 6];
    /// Raises `best` to the largest values of `sign` · volume along rays, clamped to the limit.
    fn widen(&self, base: [i32; 3], stretch: &RaySpan, sign_and_limit: [f32; 2], best: &mut [f32; FAN]);
    fn sum_up(&self, base: [i32; 3], stretch: &RaySpan, sums: &mut [[f64; FAN]; 2]);
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct TypedSampler<'a, T> {
    pub grid: Grid,
    pub voxels: &'a [T],
    pub isa: Isa,
}

impl<T: Voxel> Sampler for TypedSampler<'_, T> {
    fn along(&self, base: [i32; 3], line: &Line) -> [[f32; FAN]; STEPS] {
        dispatch(self.isa, SampleRun { sampler: self, base, run: line })
    }

    fn around(&self, base: [i32; 3], neighbours: &Around) -> [[f32; FAN]; 6] {
        dispatch(self.isa, SampleRun { sampler: self, base, run: neighbours })
    }

    fn widen(&self, base: [i32; 3], stretch: &RaySpan, [sign, limit]: [f32; 2], best: &mut [f32; FAN]) {
        let Self { grid, voxels, isa } = self;
        dispatch(*isa, CellWalk { grid, voxels, base, stretch, sign, fold: Largest { best, limit } });
    }

    fn sum_up(&self, base: [i32; 3], stretch: &RaySpan, sums: &mut [[f64; FAN]; 2]) {
        let Self { grid, voxels, isa } = self;
        dispatch(*isa, CellWalk { grid, voxels, base, stretch, sign: 1.0, fold: Sums(sums) });
    }
}

struct SampleRun<'a, T, P, const N: usize> {
    sampler: &'a TypedSampler<'a, T>,
    base: [i32; 3],
    run: &'a P,
}

impl<T: Voxel, P: SampledRun, const N: usize> Kernel for SampleRun<'_, T, P, N> {
    type Output = [[f32; FAN]; N];

    #[inline(always)]
    fn run(self) -> [[f32; FAN]; N] {
        self.sampler.grid.sample(self.sampler.voxels, self.base, self.run)
    }
}
