//! The blur of a volume: point spread of the scanner, averaging over a voxel, and interpolation.

use std::f64::consts::LN_2;

use glam::{DMat2, DMat3, DVec3};

use super::SectionPlane;

/// Variance of the blur by averaging over a voxel, in squared voxel sides.
const AVERAGING: f64 = 1.0 / 12.0;

/// Variance of the blur by linear interpolation (squared voxel sides): its mean over positions between voxels.
const INTERPOLATION: f64 = 1.0 / 6.0;

/// Variance of a Gaussian whose full width at half maximum is `fwhm`.
pub fn variance_of(fwhm: f64) -> f64 {
    fwhm * fwhm / (8.0 * LN_2)
}

pub(crate) fn fwhm_of(variance: f64) -> f64 {
    (8.0 * LN_2 * variance).sqrt()
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Blur {
    point_spread: f64,
    /// Sum of the outer products of each voxel side with itself (mm²).
    voxel: DMat3,
}

impl Blur {
    /// The blur for a point spread of `fwhm` mm; the columns of `sides` are the voxel sides (mm).
    pub(crate) fn new(fwhm: f64, sides: DMat3) -> Self {
        Self { point_spread: variance_of(fwhm), voxel: sides * sides.transpose() }
    }

    /// Covariance (mm²), within the plane, of the blur of voxel values.
    pub(crate) fn of_voxels(&self, place: &SectionPlane) -> DMat2 {
        self.in_plane(place, AVERAGING)
    }

    /// Covariance (mm²), within the plane, of the blur of interpolated values.
    pub(crate) fn interpolated(&self, place: &SectionPlane) -> DMat2 {
        self.in_plane(place, AVERAGING + INTERPOLATION)
    }

    /// Smallest and largest spacing of the voxels within the plane (mm).
    pub(crate) fn spacing(&self, place: &SectionPlane) -> [f64; 2] {
        let [u, v] = place.axes;
        let along = |a: DVec3, b: DVec3| a.dot(self.voxel * b);
        let (middle, half) = (f64::midpoint(along(u, u), along(v, v)), 0.5 * (along(u, u) - along(v, v)));
        let apart = half.hypot(along(u, v));
        [middle - apart, middle + apart].map(|square| square.max(0.0).sqrt())
    }

    /// FWHM (mm) of the blur of voxel values within the plane, averaged over directions.
    pub(crate) fn width(&self, place: &SectionPlane) -> f64 {
        fwhm_of(self.of_voxels(place).determinant().sqrt())
    }

    /// Blur variance along the vessel (mm²) if voxel weights fall linearly to 0 at `thickness` mm from the plane.
    pub(crate) fn along(&self, place: &SectionPlane, thickness: f64) -> f64 {
        let voxel = place.normal.dot(self.voxel * place.normal) * AVERAGING;
        // t²/6 is the variance of weights that fall linearly from the plane to 0 at t.
        self.point_spread + voxel + thickness * thickness / 6.0
    }

    fn in_plane(&self, place: &SectionPlane, share: f64) -> DMat2 {
        let [u, v] = place.axes;
        let along = |a: DVec3, b: DVec3| a.dot(self.voxel * b) * share;
        let mixed = along(u, v);
        DMat2::from_cols_array(&[
            along(u, u) + self.point_spread,
            mixed,
            mixed,
            along(v, v) + self.point_spread,
        ])
    }
}

#[cfg(test)]
#[path = "tests/blur.rs"]
mod tests;
