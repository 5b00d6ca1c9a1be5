//! Values along a ray, taken where they are first needed.

use glam::DVec3;

use crate::voxels::Voxels;

/// The samples of a ray, taken where they are first needed.
pub(crate) struct Ray<'a, 'v> {
    voxels: &'a Voxels<'v>,
    start: DVec3,
    stride: DVec3,
    values: Vec<f32>,
}

impl<'a, 'v> Ray<'a, 'v> {
    /// The ray from a place on, in steps of `stride`, both in index space.
    pub(crate) fn new(voxels: &'a Voxels<'v>, start: DVec3, stride: DVec3) -> Self {
        Self { voxels, start, stride, values: Vec::with_capacity(64) }
    }

    /// The value of a sample; not a number outside.
    pub(crate) fn value(&mut self, n: usize) -> f64 {
        while n >= self.values.len() {
            self.voxels.along(self.start, self.stride, &mut self.values);
        }
        f64::from(self.values[n])
    }

    /// The darkest or brightest of some samples, numbers alone.
    pub(crate) fn extreme(&mut self, first: usize, last: usize, is_dark: bool) -> f64 {
        self.value(last);
        let finite = self.values[first..=last].iter().map(|v| f64::from(*v)).filter(|v| v.is_finite());
        if is_dark { finite.fold(f64::MAX, f64::min) } else { finite.fold(f64::MIN, f64::max) }
    }
}
