//! Values along a ray, sampled on demand.

use glam::DVec3;

use crate::voxels::Voxels;

pub(crate) struct Ray<'a, 'v> {
    voxels: &'a Voxels<'v>,
    start: DVec3,
    stride: DVec3,
    values: Vec<f32>,
}

impl<'a, 'v> Ray<'a, 'v> {
    /// `start` and `stride` are in voxel index coordinates.
    pub(crate) fn new(voxels: &'a Voxels<'v>, start: DVec3, stride: DVec3) -> Self {
        Self { voxels, start, stride, values: Vec::with_capacity(64) }
    }

    pub(crate) fn value(&mut self, n: usize) -> f64 {
        while n >= self.values.len() {
            self.voxels.along(self.start, self.stride, &mut self.values);
        }
        f64::from(self.values[n])
    }

    pub(crate) fn extreme(&mut self, first: usize, last: usize, is_dark: bool) -> f64 {
        self.value(last);
        let finite = self.values[first..=last].iter().map(|v| f64::from(*v)).filter(|v| v.is_finite());
        if is_dark { finite.fold(f64::MAX, f64::min) } else { finite.fold(f64::MIN, f64::max) }
    }
}
