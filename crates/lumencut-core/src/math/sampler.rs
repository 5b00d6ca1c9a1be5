//! A volume of any type of voxel, sampled by one code.

use super::cell_walk::{CellWalk, Largest, Sums};
use super::lanes::{FAN, Isa, Kernel, dispatch};
use super::ray::{Line, RaySpan, STEPS};
use super::sampling::{Around, Grid, SampledRun};
use crate::volume::Voxel;

/// A volume whose voxels may be of any type, on the instruction set that was chosen for it: so that the rays need not
/// be compiled for every type of voxel.
pub trait Sampler: Sync {
    /// The volume at the samples of a segment of rays.
    fn along(&self, base: [i32; 3], line: &Line) -> [[f32; FAN]; STEPS];
    /// The volume at the neighbours of sixteen places.
    fn around(&self, base: [i32; 3], neighbours: &Around) -> [[f32; FAN]; 6];
    /// Widens the largest values times the sign by those along a stretch of rays; those above the limit count as the limit.
    fn widen(&self, base: [i32; 3], stretch: &RaySpan, sign_and_limit: [f32; 2], best: &mut [f32; FAN]);
    /// Adds the integrals of the volume along a stretch of rays, and their lengths (mm).
    fn sum_up(&self, base: [i32; 3], stretch: &RaySpan, sums: &mut [[f64; FAN]; 2]);
}

/// Voxels of one type.
#[derive(Clone, Copy, Debug)]
pub struct TypedSampler<'a, T> {
    /// Their grid.
    pub grid: Grid,
    /// The voxels.
    pub voxels: &'a [T],
    /// The instruction set.
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

/// [`Grid::sample`] as a kernel.
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
