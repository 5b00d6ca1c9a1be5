//! The isotropic grid in which tubes are found: cubes along the axes of the volume, made square where those are sheared.

use glam::{DAffine3, DMat3, DVec3};

use crate::voxels::Voxels;

/// How wide the narrowest vessel is at least, in voxels of the grid: finer voxels would show nothing more of it. They are no larger
/// than this where only wide vessels are asked for (mm): what is a tube is told by its surroundings too.
const VOXELS_PER_RADIUS: f64 = 1.25;
const LARGEST_FOR_RADIUS: f64 = 0.8;

/// The most voxels of the grid; of larger volumes the voxels are larger.
const MOST_VOXELS: f64 = 160e6;

/// Where the voxels of the grid lie.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// The number of voxels along each axis.
    pub size: [usize; 3],
    /// The side of a voxel (mm).
    pub side: f64,
    /// World position (LPS, mm) of a place in the grid; the centre of the first voxel is (0, 0, 0).
    pub world_from_grid: DAffine3,
    /// A place in the grid of a world position.
    pub grid_from_world: DAffine3,
}

impl Grid {
    /// A grid over a volume, whose voxels have its mean side, or what the narrowest vessel (mm) needs where that is more.
    pub(crate) fn over(voxels: &Voxels, smallest_radius: f64) -> Self {
        let matrix = voxels.world_from_index.matrix3;
        let axes = square(matrix);
        let corners = corners(voxels, axes);
        let extent = corners[1] - corners[0];
        let mean = matrix.determinant().abs().cbrt();
        let least = (extent.max(DVec3::splat(mean)).element_product() / MOST_VOXELS).cbrt();
        let side = mean.max((smallest_radius / VOXELS_PER_RADIUS).min(LARGEST_FOR_RADIUS)).max(least);
        let size = extent.to_array().map(|length| (length / side + 1e-6).floor() as usize + 1);
        // What is left over beyond the last voxel is shared by both sides.
        let spare = extent - DVec3::from_array(size.map(|n| (n - 1) as f64 * side));
        let origin = axes * (corners[0] + spare.max(DVec3::ZERO) / 2.0);
        let world_from_grid = DAffine3 { matrix3: axes * side, translation: origin };
        Self { size, side, world_from_grid, grid_from_world: world_from_grid.inverse() }
    }

    /// The world position (mm, LPS) of a place in the grid.
    pub(crate) fn world(&self, place: DVec3) -> DVec3 {
        self.world_from_grid.transform_point3(place)
    }

    /// Whether a place lies in some voxel of the grid.
    pub(crate) fn holds(&self, place: DVec3) -> bool {
        (0..3).all(|a| place[a] >= -0.5 && place[a] <= self.size[a] as f64 - 0.5)
    }
}

/// Three square unit axes: the first along the first axis of a grid, the second in the plane of its first two.
fn square(matrix: DMat3) -> DMat3 {
    let x = matrix.x_axis.normalize_or(DVec3::X);
    let y = (matrix.y_axis - x * matrix.y_axis.dot(x)).normalize_or(x.any_orthonormal_vector());
    let z = x.cross(y);
    DMat3::from_cols(x, y, if z.dot(matrix.z_axis) < 0.0 { -z } else { z })
}

/// The lowest and the highest coordinates of the voxels' centres along some axes (mm).
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
