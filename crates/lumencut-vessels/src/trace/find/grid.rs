//! The isotropic grid in which tubes are found. Its axes are those of the volume, made orthogonal if sheared.

use glam::{DAffine3, DMat3, DVec3};

use crate::voxels::Voxels;

/// Voxels per smallest radius; finer voxels would show nothing more. `LARGEST_FOR_RADIUS` limits the voxel
/// side (mm), so that the surroundings stay visible if only wide vessels are wanted.
pub(crate) const VOXELS_PER_RADIUS: f64 = 1.3;
const LARGEST_FOR_RADIUS: f64 = 0.8;

/// Maximum number of voxels of the grid; a larger volume gets larger voxels.
const MOST_VOXELS: f64 = 160e6;

#[derive(Clone, Debug)]
pub(crate) struct Grid {
    pub size: [usize; 3],
    /// Side of a grid voxel (mm).
    pub side: f64,
    /// Maps grid positions to world positions (LPS, mm). The centre of the first voxel is the grid position
    /// (0, 0, 0).
    pub(crate) world_from_grid: DAffine3,
    pub(crate) grid_from_world: DAffine3,
}

impl Grid {
    /// A grid with the mean side of the volume's voxels, or a larger one if the smallest radius (mm) allows it.
    pub(crate) fn over(voxels: &Voxels, smallest_radius: f64) -> Self {
        let matrix = voxels.world_from_index.matrix3;
        let axes = square(matrix);
        let corners = corners(voxels, axes);
        let extent = corners[1] - corners[0];
        let mean = voxels.mean_side();
        let least = (extent.max(DVec3::splat(mean)).element_product() / MOST_VOXELS).cbrt();
        let side = mean.max((smallest_radius / VOXELS_PER_RADIUS).min(LARGEST_FOR_RADIUS)).max(least);
        let size = extent.to_array().map(|length| (length / side + 1e-6).floor() as usize + 1);
        // The grid is centred in the volume.
        let spare = extent - DVec3::from_array(size.map(|n| (n - 1) as f64 * side));
        let origin = axes * (corners[0] + spare.max(DVec3::ZERO) / 2.0);
        let world_from_grid = DAffine3 { matrix3: axes * side, translation: origin };
        Self { size, side, world_from_grid, grid_from_world: world_from_grid.inverse() }
    }

    pub(crate) fn world(&self, place: DVec3) -> DVec3 {
        self.world_from_grid.transform_point3(place)
    }

    pub(crate) fn holds(&self, place: DVec3) -> bool {
        (0..3).all(|a| place[a] >= -0.5 && place[a] <= self.size[a] as f64 - 0.5)
    }
}

/// Orthonormal axes: the first along the first axis of the volume, the second in the plane of its first two.
fn square(matrix: DMat3) -> DMat3 {
    let x = matrix.x_axis.normalize_or(DVec3::X);
    let y = (matrix.y_axis - x * matrix.y_axis.dot(x)).normalize_or(x.any_orthonormal_vector());
    let z = x.cross(y);
    DMat3::from_cols(x, y, if z.dot(matrix.z_axis) < 0.0 { -z } else { z })
}

fn corners(voxels: &Voxels, axes: DMat3) -> [DVec3; 2] {
    let last = voxels.size.map(|n| (n - 1) as f64);
    let mut box_of = [DVec3::MAX, DVec3::MIN];
    for corner in 0..8 {
        let index =
            DVec3::from_array(std::array::from_fn(|a| if corner >> a & 1 == 1 { last[a] } else { 0.0 }));
        let along = axes.transpose() * voxels.world_from_index.transform_point3(index);
        box_of = [box_of[0].min(along), box_of[1].max(along)];
    }
    box_of
}

#[cfg(test)]
#[path = "tests/grid.rs"]
mod tests;
