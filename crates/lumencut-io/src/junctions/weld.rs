//! Merges points of lines that are equal or nearly so.

use glam::DVec3;

use super::Path;
use super::ids::{Id, Table, make_room};
use crate::centerlines::Line;

/// Distance up to which points are merged, as a share of the median point spacing.
const PART_OF_SPACING: f64 = 1e-3;
/// Minimum point spacing relative to the largest coordinate, so that the cells of the grid can be numbered.
const PART_OF_COORDINATE: f64 = 1e-9;

pub(super) fn resolves(lines: &[Line], spacing: f64) -> bool {
    let largest = lines.iter().flat_map(|l| &l.points).map(|p| p.abs().max_element()).fold(0.0, f64::max);
    spacing > largest * PART_OF_COORDINATE
}

/// The distinct points (each with the coordinates of its first occurrence), and the lines as paths of them.
/// The spacing must satisfy [`resolves`].
pub(super) fn weld(lines: Vec<Line>, spacing: f64) -> (Vec<DVec3>, Vec<Path>) {
    let distance = spacing * PART_OF_SPACING;
    let count = lines.iter().map(|line| line.points.len()).sum();
    let mut grid = Grid { distance, left: count, points: Vec::new(), cells: Table::default() };
    let paths = lines.into_iter().filter_map(|line| path(line, &mut grid)).collect();
    (grid.points, paths)
}

/// The line as a path; None if all its points were merged.
fn path(line: Line, grid: &mut Grid) -> Option<Path> {
    let nodes = line.points.iter().map(|p| grid.place(*p)).collect();
    let mut path = Path { nodes, radius: line.radius, group: line.group, name: line.name };
    path.drop_repeats();
    (path.nodes.len() >= 2).then_some(path)
}

/// A grid whose cells are as wide as the merging distance, so each holds only a few points.
struct Grid {
    distance: f64,
    left: usize,
    points: Vec<DVec3>,
    cells: Table,
}

impl Grid {
    fn place(&mut self, point: DVec3) -> Id {
        let cell = self.cell(point);
        self.left -= 1;
        for offset in 0..27 {
            let near = [offset % 3, offset / 3 % 3, offset / 9];
            let near = [0, 1, 2].map(|axis| cell[axis].saturating_add(near[axis] - 1));
            let is_here = |id: &Id| {
                let known = self.points[*id as usize];
                known.distance(point) < self.distance && self.cell(known) == near
            };
            if let Some(first) = self.cells.like(&near).filter(is_here).min() {
                return first;
            }
        }
        make_room(&mut self.points, self.left + 1);
        self.points.push(point);
        self.cells.push(&cell)
    }

    fn cell(&self, point: DVec3) -> [i64; 3] {
        (point / self.distance).floor().to_array().map(|c| c as i64)
    }
}
