//! The extent of a volume: decides which world points (mm, LPS) lie inside its outer corners.

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::volume::Volume;

use crate::fused;

/// Tolerance (voxels), so that corners count as inside although the affine and its inverse round.
const TOLERANCE: f64 = 1e-9;

/// The grid of a volume without its voxels.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    index_from_offset: Elimination,
    origin: DVec3,
    last: DVec3,
    smallest_side: f64,
}

impl Extent {
    /// The extent of `size` voxels (i, j, k) placed by `world_from_index`.
    pub fn new(size: [usize; 3], world_from_index: DAffine3) -> Self {
        Self {
            index_from_offset: Elimination::of(&world_from_index.matrix3),
            origin: world_from_index.translation,
            last: DVec3::from_array(size.map(|n| n as f64 - 0.5)),
            smallest_side: smallest_column(&world_from_index.matrix3),
        }
    }

    /// Whether a world point lies inside. The faces of the volume are half a voxel beyond the outermost voxel centres.
    pub fn contains(&self, point: DVec3) -> bool {
        let index = self.index_from_offset.solve(point - self.origin);
        index.cmpge(DVec3::splat(-0.5 - TOLERANCE)).all() && index.cmple(self.last + TOLERANCE).all()
    }

    /// The smallest voxel side (mm).
    pub fn smallest_side(&self) -> f64 {
        self.smallest_side
    }

    /// The number of points inside.
    pub fn count(&self, points: impl IntoIterator<Item = DVec3>) -> usize {
        points.into_iter().filter(|point| self.contains(*point)).count()
    }
}

fn smallest_column(matrix: &DMat3) -> f64 {
    let length = |column: DVec3| fused::dot(column, column).sqrt();
    [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(length).into_iter().fold(f64::INFINITY, f64::min)
}

impl From<&Volume<'_>> for Extent {
    fn from(volume: &Volume<'_>) -> Self {
        Self::new(volume.size(), volume.world_from_index())
    }
}

/// Solves a 3 × 3 linear system by elimination with pivoting. For sheared grids this is more accurate than the inverse matrix.
#[derive(Clone, Copy, Debug)]
struct Elimination {
    /// Rows in pivot order: factors of the elimination below the diagonal, the upper triangle above.
    rows: [[f64; 3]; 3],
    order: [usize; 3],
}

impl Elimination {
    fn of(matrix: &DMat3) -> Self {
        let mut rows = [0, 1, 2].map(|row| matrix.row(row).to_array());
        let mut order = [0, 1, 2];
        for column in 0..3 {
            let largest = |a: &usize, b: &usize| rows[*a][column].abs().total_cmp(&rows[*b][column].abs());
            let pivot = (column..3).rev().max_by(largest).unwrap_or(column);
            rows.swap(column, pivot);
            order.swap(column, pivot);
            for below in column + 1..3 {
                let factor = rows[below][column] / rows[column][column];
                rows[below][column] = factor;
                for right in column + 1..3 {
                    rows[below][right] -= factor * rows[column][right];
                }
            }
        }
        Self { rows, order }
    }

    fn solve(&self, right: DVec3) -> DVec3 {
        let [a, b, c] = self.rows;
        let right = self.order.map(|n| right[n]);
        let second = right[1] - b[0] * right[0];
        let third = right[2] - c[0] * right[0] - c[1] * second;
        let z = third / c[2];
        let y = (second - b[2] * z) / b[1];
        DVec3::new((right[0] - a[1] * y - a[2] * z) / a[0], y, z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheared() -> DAffine3 {
        let matrix = DMat3::from_cols_array(&[0.0, 2.0, 0.5, 3.0, 0.25, 0.0, 0.0, 1.0, -4.0]);
        DAffine3::from_mat3_translation(matrix, DVec3::new(100.0, -50.0, 7.0))
    }

    #[test]
    fn a_solution_fulfils_its_equations() {
        let matrix = sheared().matrix3;
        let index = DVec3::new(1.0, -2.0, 3.0);
        let found = Elimination::of(&matrix).solve(matrix * index);
        assert!(found.abs_diff_eq(index, 1e-14), "{found}");
    }

    #[test]
    fn the_outer_corners_are_inside_and_a_little_beyond_is_not() {
        let extent = Extent::new([5, 1, 3], sheared());
        for corner in 0..8 {
            let end =
                |axis: usize, low: f64, n: f64| if corner >> axis & 1 == 0 { -low } else { n - 1.0 + low };
            let at = |low: f64| {
                sheared().transform_point3(DVec3::new(end(0, low, 5.0), end(1, low, 1.0), end(2, low, 3.0)))
            };
            assert!(extent.contains(at(0.5)));
            assert!(!extent.contains(at(0.500_001)));
        }
    }

    #[test]
    fn what_is_no_number_is_outside() {
        let extent = Extent::new([5, 5, 5], DAffine3::IDENTITY);
        let points = [DVec3::NAN, DVec3::INFINITY, DVec3::new(1.0, f64::NAN, 1.0), DVec3::ONE];
        assert_eq!(extent.count(points), 1);
    }

    #[test]
    fn a_volume_has_the_extent_of_its_grid() {
        let voxels = lumencut_core::volume::Voxels::U8(&[0; 15]);
        let volume = Volume::new(voxels, [5, 1, 3], [1, 5, 5], sheared()).unwrap();
        let extent = Extent::from(&volume);
        assert!(extent.contains(sheared().transform_point3(DVec3::new(4.4, 0.4, 2.4))));
        assert!(!extent.contains(sheared().transform_point3(DVec3::new(4.4, 0.6, 2.4))));
    }
}
