//! A map with positions as keys, such as vessel ends; a value is found from any position near its key.

use std::collections::HashMap;

use glam::DVec3;

#[derive(Clone, Debug)]
pub(crate) struct PositionMap<T> {
    cells: HashMap<[i64; 3], Vec<(DVec3, T)>>,
    /// Positions at most this far apart (mm) count as equal.
    within: f64,
}

impl<T: Clone> PositionMap<T> {
    pub(crate) fn new(within: f64) -> Self {
        Self { cells: HashMap::new(), within }
    }

    /// The cell of a position; it is ten times wider than `within`, so most positions touch one cell only.
    fn cell(&self, place: DVec3) -> [i64; 3] {
        (place / (10.0 * self.within)).floor().as_i64vec3().to_array()
    }

    pub(crate) fn add(&mut self, place: DVec3, value: &T) {
        let (low, high) = (self.cell(place - self.within), self.cell(place + self.within));
        for (x, y) in (low[0]..=high[0]).flat_map(|x| (low[1]..=high[1]).map(move |y| (x, y))) {
            for z in low[2]..=high[2] {
                self.cells.entry([x, y, z]).or_default().push((place, value.clone()));
            }
        }
    }

    pub(crate) fn at(&self, place: DVec3) -> Option<&T> {
        let near = self.cells.get(&self.cell(place))?;
        near.iter().find(|(known, _)| known.distance(place) <= self.within).map(|(_, value)| value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_within_their_distance_across_cells_too() {
        let mut map = PositionMap::new(0.1);
        map.add(DVec3::new(0.0, 1.0, -2.0), &1);
        map.add(DVec3::new(0.05, 1.0, -2.0), &2);
        for (x, found) in [(-0.09, Some(&1)), (0.09, Some(&1)), (0.14, Some(&2)), (-0.11, None), (0.16, None)]
        {
            assert_eq!(map.at(DVec3::new(x, 1.0, -2.0)), found, "{x}");
        }
    }
}
