//! Lists possible spaces and units of coordinates, and counts the points inside a volume for each of them.

use std::fmt;

use glam::DVec3;
use lumencut_io::{Space, Unit};

use crate::extent::Extent;
use crate::fused;
use crate::text::rounded;

/// The smallest plausible extent of vessels (mm).
pub const SMALLEST: f64 = 8.0;
/// The largest plausible extent of vessels (mm).
pub const LARGEST: f64 = 2500.0;
/// Lines are ignored if they are shorter than both this number of voxels and [`SHORTEST`].
const FEW_VOXELS: f64 = 3.0;
/// Lines at least this long (mm) are never ignored.
const SHORTEST: f64 = 1.0;
const DIGITS: usize = 3;
/// A reading is as good as another if it has at least this fraction of the other's points inside the volume.
const AS_GOOD: f64 = 0.8;

/// A space and a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoordinateSystem {
    /// Patient coordinates, LPS or RAS.
    pub space: Space,
    /// The unit.
    pub unit: Unit,
}

impl CoordinateSystem {
    /// The factor of each axis that converts coordinates in this space and unit to LPS in mm.
    pub fn scale(self) -> DVec3 {
        signs(self.space) * self.unit.in_mm()
    }

    /// The correction, in words, for coordinates in this space and unit that were read as LPS in mm.
    pub(crate) fn mistaken(self) -> String {
        let mut how = Vec::new();
        if self.space == Space::Ras {
            how.push("with x and y negated (LPS and RAS mixed up?)".to_owned());
        }
        if self.unit != Unit::Millimetre {
            how.push(format!("{} times as large (another unit?)", self.unit.in_mm()));
        }
        how.join(" and ")
    }
}

impl fmt::Display for CoordinateSystem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} in {}", self.space.name(), self.unit.name())
    }
}

/// What a caller can state about coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statement {
    /// The space.
    pub space: Option<Space>,
    /// The unit.
    pub unit: Option<Unit>,
}

/// The sign of each axis that converts coordinates of a space to LPS.
pub fn signs(space: Space) -> DVec3 {
    match space {
        Space::Lps => DVec3::ONE,
        Space::Ras => DVec3::new(-1.0, -1.0, 1.0),
    }
}

/// All combinations of spaces and units, grouped by space.
pub fn places(spaces: &[Space], units: &[Unit]) -> Vec<CoordinateSystem> {
    spaces
        .iter()
        .flat_map(|space| units.iter().map(|unit| CoordinateSystem { space: *space, unit: *unit }))
        .collect()
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reading {
    pub place: CoordinateSystem,
    pub inside: usize,
    /// The diagonal of the vessels' bounding box (mm).
    pub across: f64,
    /// Whether vessels can have that size: in mm also short pieces of a few voxels; in other units only sizes found in a body.
    pub(crate) is_plausible: bool,
}

impl Reading {
    /// The number of points inside; 0 if the size is implausible.
    pub(crate) fn fits(&self) -> usize {
        if self.is_plausible { self.inside } else { 0 }
    }

    /// Whether the vessels are so short that every other unit that fits is just as likely.
    pub(crate) fn is_short(&self) -> bool {
        self.across < SMALLEST
    }

    pub(crate) fn is_as_good_as(&self, inside: usize) -> bool {
        self.fits() as f64 >= AS_GOOD * inside as f64
    }

    pub(crate) fn is_clearly_better_than(&self, inside: usize, total: usize) -> bool {
        self.fits() >= 2 * inside && self.fits() >= inside + (total / 10).max(1)
    }
}

pub(crate) fn readings(points: &[DVec3], candidates: &[CoordinateSystem], volume: &Extent) -> Vec<Reading> {
    let bare = across(points);
    let reading = |place: &CoordinateSystem| {
        let across = bare * place.unit.in_mm();
        let is_of_body = place.unit == Unit::Millimetre || (SMALLEST..=LARGEST).contains(&across);
        let is_plausible = is_of_body && across >= (FEW_VOXELS * volume.smallest_side()).min(SHORTEST);
        let scale = place.scale();
        let inside = volume.count(points.iter().map(|p| *p * scale));
        Reading { place: *place, inside, across, is_plausible }
    };
    candidates.iter().map(reading).collect()
}

/// A length for messages.
pub fn mm(length: f64) -> String {
    format!("{} mm", rounded(length, DIGITS))
}

/// The diagonal of the points' bounding box; 0 without points.
pub fn across(points: &[DVec3]) -> f64 {
    let (low, high) =
        points.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(*p), high.max(*p)));
    let sides = if points.is_empty() { DVec3::ZERO } else { high - low };
    fused::dot(sides, sides).sqrt()
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;

    use super::*;

    #[test]
    fn a_place_brings_coordinates_to_lps_in_mm() {
        let place = CoordinateSystem { space: Space::Ras, unit: Unit::Centimetre };
        assert_eq!(DVec3::new(1.0, 2.0, 3.0) * place.scale(), DVec3::new(-10.0, -20.0, 30.0));
        assert_eq!(place.to_string(), "ras in cm");
    }

    #[test]
    fn places_go_space_by_space() {
        let all = places(&Space::ALL, &Unit::ALL);
        assert_eq!(all.len(), 10);
        assert_eq!(all[1], CoordinateSystem { space: Space::Lps, unit: Unit::Millimetre });
        assert_eq!(all[5], CoordinateSystem { space: Space::Ras, unit: Unit::Micrometre });
    }

    #[test]
    fn what_is_no_size_of_vessels_counts_nowhere() {
        let volume = Extent::new([100; 3], DAffine3::IDENTITY);
        let counted = |points: &[DVec3]| {
            readings(points, &places(&[Space::Lps], &Unit::ALL), &volume)
                .iter()
                .map(Reading::fits)
                .collect::<Vec<_>>()
        };
        // A line of 4 units is a short piece in mm; 40 mm in cm; in dm, 400 mm with one end outside; and 4 m.
        assert_eq!(counted(&[DVec3::ZERO, DVec3::X * 4.0]), [0, 2, 2, 1, 0]);
        // The line is shorter than three voxels and than 1 mm.
        assert_eq!(counted(&[DVec3::ZERO, DVec3::X * 0.9]), [0, 0, 2, 2, 1]);
        assert_eq!(counted(&[]), [0; 5]);
    }

    #[test]
    fn the_diagonal_is_that_of_the_box() {
        let points = [DVec3::new(1.0, 5.0, 0.0), DVec3::new(4.0, 1.0, 12.0), DVec3::new(2.0, 3.0, 4.0)];
        assert_eq!(across(&points), 13.0);
    }
}
