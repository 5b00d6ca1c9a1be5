//! An index by cubic cells that finds the points near a position.

use glam::DVec3;

/// Number of bits per cell coordinate.
const BITS: u32 = 21;
const MAX_CELL: f64 = ((1_u64 << BITS) - 1) as f64;

pub(crate) struct PointGrid {
    places: Vec<DVec3>,
    /// Sorted pairs of cell number and point number.
    cells: Vec<(u64, u32)>,
    low: DVec3,
    high: DVec3,
    side: f64,
}

impl PointGrid {
    pub(crate) fn new(places: Vec<DVec3>, side: f64) -> Self {
        let first = places.first().copied().unwrap_or_default();
        let low = places.iter().copied().fold(first, DVec3::min);
        let high = places.iter().copied().fold(first, DVec3::max);
        let mut grid = Self { places, cells: Vec::new(), low, high, side };
        let numbered = grid.places.iter().zip(0..);
        grid.cells = numbered.map(|(place, n)| (number(grid.cell(*place)), n)).collect();
        grid.cells.sort_unstable();
        grid
    }

    pub(crate) fn near(&self, place: DVec3, reach: f64, mut visit: impl FnMut(usize)) {
        let [first, last] = [-reach, reach].map(|way| self.cell(place + way));
        for z in first[2]..=last[2] {
            for y in first[1]..=last[1] {
                let [from, to] = [number([first[0], y, z]), number([last[0], y, z])];
                let begin = self.cells.partition_point(|(cell, _)| *cell < from);
                for (_, point) in self.cells[begin..].iter().take_while(|(cell, _)| *cell <= to) {
                    if self.places[*point as usize].distance_squared(place) <= reach * reach {
                        visit(*point as usize);
                    }
                }
            }
        }
    }

    fn cell(&self, place: DVec3) -> [u64; 3] {
        let inside = place.clamp(self.low, self.high);
        ((inside - self.low) / self.side).to_array().map(|c| c.min(MAX_CELL) as u64)
    }
}

fn number([x, y, z]: [u64; 3]) -> u64 {
    (z << (2 * BITS)) | (y << BITS) | x
}

#[cfg(test)]
#[path = "tests/point_grid.rs"]
mod tests;
