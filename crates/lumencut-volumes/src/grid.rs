//! The grids that a volume can have.

use crate::error::Error;
use crate::plan::{Affine, Grid};
use crate::text::short;

/// Largest coordinate (mm), and the most voxels per mm.
const FARTHEST: f64 = 1e9;
/// Smallest volume of a voxel as a share of the box that has the same sides.
const FLATTEST: f64 = 1e-9;

/// What is wrong with a grid of this size, and what is expected; None for a grid that a volume can have. A grid is
/// finite and within 10⁹ mm; its axes are no shorter than 10⁻⁹ mm and span a volume.
#[must_use]
pub fn grid_fault(size: [u64; 3], world_from_index: &Affine) -> Option<(String, &'static str)> {
    let rows = world_from_index;
    let expected = if !rows.as_flattened().iter().all(|value| value.is_finite()) {
        "finite numbers"
    } else if !rows.iter().all(|row| reach(size, row) < FARTHEST) {
        "a grid within 1e+09 mm"
    } else if !spans_a_volume(rows) {
        "an invertible affine whose last row is 0 0 0 1"
    } else {
        return None;
    };
    let rows = rows.map(|row| format!("[{}]", row.map(|value| short(value, 6)).join(", ")));
    Some((format!("[{}]", rows.join(", ")), expected))
}

fn reach(size: [u64; 3], row: &[f64; 4]) -> f64 {
    row[3].abs() + (0..3).map(|axis| row[axis].abs() * size[axis] as f64).sum::<f64>()
}

fn spans_a_volume(rows: &Affine) -> bool {
    let axis = |column: usize| [rows[0][column], rows[1][column], rows[2][column]];
    let axes = [axis(0), axis(1), axis(2)];
    let lengths = axes.map(|[x, y, z]| (x * x + y * y + z * z).sqrt());
    let [a, b, c] = [0, 1, 2].map(|at| axes[at].map(|value| value / lengths[at]));
    let across = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let share = across[0] * c[0] + across[1] * c[1] + across[2] * c[2];
    lengths.iter().all(|&length| length > 1.0 / FARTHEST) && share.abs() > FLATTEST
}

impl Grid {
    /// Rejects a grid that no volume of this size can have.
    pub(crate) fn check(&self, path: &str, size: [u64; 3]) -> Result<(), Box<Error>> {
        let Some((found, expected)) = grid_fault(size, &self.world_from_index) else { return Ok(()) };
        let error = Error::new(path, format!("world_from_index of the volume {found}"), expected);
        Err(error.mend("correct the position of the volume"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_finite_near_and_spans_a_volume() {
        let sheared = [[0.5, 0.2, 0.0, -10.0], [0.0, 0.5, 0.0, 9.9e8], [0.0, 0.0, -1.0, 0.0]];
        assert_eq!(grid_fault([512, 512, 99], &sheared), None);
        let with = |row: usize, column: usize, value: f64| {
            let mut rows = sheared;
            rows[row][column] = value;
            grid_fault([512, 512, 99], &rows).map(|fault| fault.1)
        };
        let far = Some("a grid within 1e+09 mm");
        assert_eq!([with(0, 0, 2e6), with(2, 3, -1e9), with(1, 3, 1e300)], [far; 3]);
        assert_eq!([with(0, 0, f64::NAN), with(0, 3, f64::INFINITY)], [Some("finite numbers"); 2]);
        let flat = Some("an invertible affine whose last row is 0 0 0 1");
        assert_eq!([with(2, 2, 0.0), with(2, 2, 1e-9), with(1, 1, 1e-11)], [flat; 3]);
        assert_eq!([with(2, 2, 1e-8), with(1, 1, 1e-8)], [None; 2]);
    }
}
