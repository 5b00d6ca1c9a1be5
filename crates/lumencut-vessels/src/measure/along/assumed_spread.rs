//! The point spread that is assumed if none is given and no vessel shows one.

use glam::{DMat3, DVec3};

use crate::measure::estimation::Level;
use lumencut_core::math::statistics::median;

/// FWHM (voxel sides), and its relative standard deviation.
const SIDES: Level = [1.2, 0.2];

/// Minimum FWHM (mm) in CT of the body, and minimum standard deviation. Usual kernels halve the contrast of 3.5 to 9
/// line pairs per cm, like Gaussians of 1.25 to 0.5 mm, and voxels are often smaller.
const BODY_CT: Level = [0.85, 0.2];

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AssumedSpread {
    /// FWHM and its standard deviation (mm).
    pub(crate) fwhm: Level,
    /// Whether the voxels are so small that only the kernel decides.
    is_of_kernel: bool,
}

impl AssumedSpread {
    /// The assumption for a scan, from the middle of the voxel `sides`; in CT it is at least the blur of usual kernels.
    pub(crate) fn of(sides: DMat3, is_ct: bool) -> Self {
        let mut lengths = [sides.x_axis, sides.y_axis, sides.z_axis].map(DVec3::length);
        let [share, unsure] = SIDES;
        let by_voxels = share * median(&mut lengths).unwrap_or_default();
        if !is_ct {
            return Self { fwhm: [by_voxels, unsure * by_voxels], is_of_kernel: false };
        }
        let [least, deviation] = BODY_CT;
        let fwhm = [by_voxels.max(least), deviation.max(unsure * by_voxels)];
        Self { fwhm, is_of_kernel: by_voxels < least }
    }

    /// The assumption if vessels show that the blur is less than that of usual kernels.
    pub(crate) fn of_voxels(sides: DMat3) -> Self {
        Self::of(sides, false)
    }

    /// What it is based on, in words.
    pub(crate) fn from(self) -> String {
        if self.is_of_kernel {
            format!("{} mm, usual in CT of the body", self.fwhm[0])
        } else {
            format!("{} sides of a voxel", SIDES[0])
        }
    }
}
