//! Remedies for errors in files. Programs apply them, or state them in their own words.

use std::fmt;

use crate::space::Space;
use crate::unit::Unit;

/// A remedy for an [`Error`](crate::Error). Users see it as a Python argument, a command-line option or a
/// button. The text of [`fmt::Display`] is for Rust programs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mend {
    /// State the space of the coordinates, LPS or RAS, because the volume cannot decide it.
    Coordinates,
    /// State the unit (one of these), because the volume cannot decide it.
    Unit(Vec<Unit>),
    /// State space and unit, because no combination fits the volume.
    Place,
    /// Sort the points of each line along the vessel.
    Reorder,
    /// State space and unit (one of these pairs), because the volume cannot decide them.
    Reading(Vec<(Space, Unit)>),
}

/// Names of pairs: a row for each space, a column for each unit.
const READINGS: [[&str; 5]; 2] = [
    ["lps in um", "lps in mm", "lps in cm", "lps in dm", "lps in m"],
    ["ras in um", "ras in mm", "ras in cm", "ras in dm", "ras in m"],
];

impl Mend {
    /// Names of all remedies.
    pub const NAMES: [&str; 5] = ["coordinates", "unit", "place", "reading", "reorder"];

    /// The name by which programs recognise the remedy.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Coordinates => "coordinates",
            Self::Unit(_) => "unit",
            Self::Place => "place",
            Self::Reorder => "reorder",
            Self::Reading(_) => "reading",
        }
    }

    /// The values to choose from: spaces, units, or pairs such as `lps in cm`.
    #[must_use]
    pub fn values(&self) -> Vec<&'static str> {
        match self {
            Self::Coordinates | Self::Place => Space::ALL.map(Space::name).to_vec(),
            Self::Unit(units) => units.iter().map(|unit| unit.name()).collect(),
            Self::Reorder => Vec::new(),
            Self::Reading(all) => {
                all.iter().map(|(space, unit)| READINGS[*space as usize][*unit as usize]).collect()
            }
        }
    }
}

impl fmt::Display for Mend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let values = self.values().join(" or ");
        match self {
            Self::Coordinates => write!(f, "state the space, {values}"),
            Self::Unit(_) => write!(f, "state the unit, {values}"),
            Self::Reading(_) => write!(f, "state the space and the unit, {values}"),
            Self::Place => {
                write!(f, "state the space, {values}, and the unit if the file belongs to this volume")
            }
            Self::Reorder => f.write_str("sort the points along the vessel"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mend_has_its_name_and_its_choice() {
        let readings = Space::ALL.into_iter().flat_map(|space| Unit::ALL.map(|unit| (space, unit)));
        let named = |(space, unit): (Space, Unit)| format!("{} in {}", space.name(), unit.name());
        let reading = Mend::Reading(readings.clone().collect());
        assert_eq!(reading.values(), readings.map(named).collect::<Vec<_>>());
        let units = Mend::Unit(vec![Unit::Centimetre, Unit::Metre]);
        let reading = Mend::Reading(vec![(Space::Ras, Unit::Metre)]);
        let all = [Mend::Coordinates, units, Mend::Place, reading, Mend::Reorder];
        assert_eq!(all.each_ref().map(Mend::name), Mend::NAMES);
        let values = [vec!["lps", "ras"], vec!["cm", "m"], vec!["lps", "ras"], vec!["ras in m"], vec![]];
        assert_eq!(all.each_ref().map(Mend::values), values);
    }

    #[test]
    fn it_stands_behind_the_advice() {
        let error = crate::Error::new("lines.csv", "a", "b");
        let line = |error: crate::Error| error.to_string();
        assert_eq!(line(error.clone()), "lines.csv: found a; expected b");
        assert_eq!(line(error.clone().mend("c")), "lines.csv: found a; expected b; c");
        let mended = error.mended_by(Mend::Coordinates);
        assert_eq!(line(mended.clone()), "lines.csv: found a; expected b; state the space, lps or ras");
        assert_eq!(
            line(mended.mend("c")),
            "lines.csv: found a; expected b; c, or state the space, lps or ras"
        );
    }
}
