//! What blurs a lumen: the point spread of the scanner, the averaging over a voxel, and interpolation between voxels.

use std::f64::consts::LN_2;

use glam::{DMat2, DMat3, DVec3};

use super::place::Place;

/// The variance of what is averaged over a voxel, in squares of its side.
const AVERAGING: f64 = 1.0 / 12.0;

/// The variance that linear interpolation adds, in squares of the side of a voxel, as a mean over all places between voxels.
const INTERPOLATION: f64 = 1.0 / 6.0;

/// The variance of a Gaussian with this full width at half maximum.
pub fn variance_of(fwhm: f64) -> f64 {
    fwhm * fwhm / (8.0 * LN_2)
}

/// The full width at half maximum of a Gaussian with this variance.
pub fn fwhm_of(variance: f64) -> f64 {
    (8.0 * LN_2 * variance).sqrt()
}

/// The blur of a volume.
#[derive(Clone, Copy, Debug)]
pub struct Blur {
    point_spread: f64,
    /// The sum of the products of each side of a voxel with itself (mm²).
    voxel: DMat3,
}

impl Blur {
    /// The blur of a scanner with this point spread (FWHM, mm) on voxels with these sides (the columns).
    pub fn new(fwhm: f64, sides: DMat3) -> Self {
        Self { point_spread: variance_of(fwhm), voxel: sides * sides.transpose() }
    }

    /// The covariance in the plane of a section of what voxels show (mm²).
    pub fn of_voxels(&self, place: &Place) -> DMat2 {
        self.in_plane(place, AVERAGING)
    }

    /// The covariance in the plane of a section of what is interpolated between voxels (mm²).
    pub fn interpolated(&self, place: &Place) -> DMat2 {
        self.in_plane(place, AVERAGING + INTERPOLATION)
    }

    /// The full width at half maximum of what voxels show in the plane of a section, a mean over all directions (mm).
    pub fn width(&self, place: &Place) -> f64 {
        fwhm_of(self.of_voxels(place).determinant().sqrt())
    }

    /// The variance along the vessel of what the voxels around the plane of a section show (mm²); they are weighted by how near
    /// they lie, up to so far (mm).
    pub fn along(&self, place: &Place, thickness: f64) -> f64 {
        let voxel = place.normal.dot(self.voxel * place.normal) * AVERAGING;
        // The variance of a triangle.
        self.point_spread + voxel + thickness * thickness / 6.0
    }

    fn in_plane(&self, place: &Place, share: f64) -> DMat2 {
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
