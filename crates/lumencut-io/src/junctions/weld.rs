//! Points of lines that are the same place become one point.

use std::collections::HashMap;

use glam::DVec3;

use super::Path;
use crate::centerlines::Line;

/// Weld distance as a part of the median spacing of the points.
const PART_OF_SPACING: f64 = 1e-3;
/// The smallest spacing as a part of the largest coordinate: the cells of the grid stay countable.
const PART_OF_COORDINATE: f64 = 1e-9;

/// Whether the spacing is wide enough to tell places apart.
pub fn resolves(lines: &[Line], spacing: f64) -> bool {
    let largest = lines.iter().flat_map(|l| &l.points).map(|p| p.abs().max_element()).fold(0.0, f64::max);
    spacing > largest * PART_OF_COORDINATE
}

/// The places that the points of all lines are, and the lines as paths through them. A place has the
/// coordinates of the first point that was found there. The spacing [`resolves`] the lines.
pub fn weld(lines: Vec<Line>, spacing: f64) -> (Vec<DVec3>, Vec<Path>) {
    let distance = spacing * PART_OF_SPACING;
    let mut grid = Grid { distance, points: Vec::new(), cells: HashMap::new() };
    let paths = lines.into_iter().filter_map(|line| path(line, &mut grid)).collect();
    (grid.points, paths)
}

/// The path of a line; `None` where all its points are one place.
fn path(line: Line, grid: &mut Grid) -> Option<Path> {
    let all: Vec<usize> = line.points.into_iter().map(|p| grid.place(p)).collect();
    let kept: Vec<usize> = (0..all.len()).filter(|i| *i == 0 || all[*i] != all[i - 1]).collect();
    let nodes: Vec<usize> = kept.iter().map(|i| all[*i]).collect();
    let radius = line.radius.map(|radius| kept.iter().map(|i| radius[*i]).collect());
    (nodes.len() >= 2).then_some(Path { nodes, radius, group: line.group, name: line.name })
}

/// Points in cubic cells as wide as the weld distance, which may hold only a few points each.
struct Grid {
    distance: f64,
    points: Vec<DVec3>,
    cells: HashMap<[i64; 3], Vec<usize>>,
}

impl Grid {
    /// The id of the place at `point`.
    fn place(&mut self, point: DVec3) -> usize {
        let cell = (point / self.distance).floor().to_array().map(|c| c as i64);
        for offset in 0..27 {
            let near = [offset % 3, offset / 3 % 3, offset / 9];
            let near = [0, 1, 2].map(|axis| cell[axis].saturating_add(near[axis] - 1));
            let known = self.cells.get(&near).into_iter().flatten();
            if let Some(id) = known.copied().find(|id| self.points[*id].distance(point) < self.distance) {
                return id;
            }
        }
        self.points.push(point);
        self.cells.entry(cell).or_default().push(self.points.len() - 1);
        self.points.len() - 1
    }
}
