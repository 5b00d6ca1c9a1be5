//! Chooses space and unit of centerlines by the numbers of points that fit the volume, and describes these numbers.

use std::collections::BTreeSet;

use lumencut_io::{Error, Mend, Result, Space, Unit};

use crate::lumen_points::LumenCount;
use crate::places::{CoordinateSystem, Reading, Statement, mm};

type Lumen<'a> = &'a dyn Fn(CoordinateSystem) -> LumenCount;

pub(crate) struct Choice {
    pub(crate) readings: Vec<Reading>,
    /// The space and unit that are used unless the volume contradicts them.
    pub usual: CoordinateSystem,
    pub(crate) total: usize,
}

pub(crate) struct Chosen {
    pub(crate) best: Reading,
    /// If the values of the volume decided the space or the unit: the evidence.
    pub by_values: Option<ByValues>,
    /// Other units that fit the volume too.
    pub also: Vec<Unit>,
}

#[derive(Clone, Debug)]
pub(crate) struct ByValues {
    /// Whether the values of the volume decided the space.
    pub space: bool,
    /// Whether the values of the volume decided for another unit than the usual one.
    pub unit: bool,
    pub words: String,
}

struct OfOneUnit {
    readings: Vec<Reading>,
    words: Option<String>,
    also: Vec<Unit>,
}

impl OfOneUnit {
    fn unopposed(readings: Vec<Reading>) -> Self {
        Self { readings, words: None, also: Vec::new() }
    }
}

impl Chosen {
    fn by_extent(best: Reading) -> Self {
        Self { best, by_values: None, also: Vec::new() }
    }
}

impl Choice {
    /// The space and unit that fit the volume best. If only one space is possible and nothing fits, the usual ones.
    pub(crate) fn best(&self, lumen: Lumen) -> Result<Chosen> {
        let most = self.readings.iter().map(Reading::fits).max().unwrap_or(0);
        let spaces: BTreeSet<&str> = self.readings.iter().map(|reading| reading.place.space.name()).collect();
        if most == 0 && spaces.len() == 1 {
            let usual = self.readings.iter().find(|reading| reading.place == self.usual);
            let nowhere = |usual: &Reading| Chosen::by_extent(Reading { inside: 0, ..*usual });
            return usual.map(nowhere).ok_or_else(|| self.nowhere(&spaces));
        }
        if most == 0 {
            return Err(self.nowhere(&spaces));
        }
        let fitting: Vec<Reading> =
            self.readings.iter().filter(|reading| reading.is_as_good_as(most)).copied().collect();
        let found = self.of_one_unit(&fitting, lumen)?;
        let (best, by_values) = match found.readings[..] {
            [one, other] => {
                let (best, words) =
                    self.space_by_values(one, other, lumen).ok_or_else(|| match found.also[..] {
                        [] => self.undecided(&[one, other]),
                        // If the unit is uncertain too, the error asks the user for both.
                        _ => self.undecided(&fitting),
                    })?;
                (best, Some(ByValues { space: true, unit: found.words.is_some(), words }))
            }
            [only, ..] => {
                let by_values = |words| ByValues { space: false, unit: true, words };
                (only, found.words.map(by_values))
            }
            [] => return Err(self.nowhere(&spaces)),
        };
        Ok(Chosen { best, by_values, also: found.also })
    }

    /// The candidates with a single unit: the unit in which points clearly look like lumen, else the usual unit. An error if the
    /// lines would be so short in the usual unit that other units are possible.
    fn of_one_unit(&self, fitting: &[Reading], lumen: Lumen) -> Result<OfOneUnit> {
        let units = units_of(fitting);
        if units.len() < 2 {
            return Ok(OfOneUnit::unopposed(fitting.to_vec()));
        }
        let of =
            |unit| fitting.iter().filter(|reading| reading.place.unit == unit).copied().collect::<Vec<_>>();
        let usual = of(self.usual.unit);
        match self.unit_by_values(fitting, lumen) {
            Some((unit, _)) if unit == self.usual.unit => Ok(OfOneUnit::unopposed(usual)),
            Some((unit, words)) => Ok(OfOneUnit { readings: of(unit), words: Some(words), also: Vec::new() }),
            None if usual.iter().all(Reading::is_short) => Err(self.undecided(fitting)),
            None => {
                let also = units.into_iter().filter(|unit| *unit != self.usual.unit).collect();
                Ok(OfOneUnit { readings: usual, words: None, also })
            }
        }
    }

    fn unit_by_values(&self, fitting: &[Reading], lumen: Lumen) -> Option<(Unit, String)> {
        let counts: Vec<(CoordinateSystem, LumenCount)> =
            fitting.iter().map(|reading| (reading.place, lumen(reading.place))).collect();
        let (best, most) = counts.iter().max_by_key(|(_, count)| count.like_lumen)?;
        let others = counts.iter().filter(|(place, _)| place.unit != best.unit);
        if !others.clone().all(|(_, count)| most.is_evident_over(*count)) {
            return None;
        }
        let lumen_words = |(place, count): &(CoordinateSystem, LumenCount)| {
            format!("{} of {} sampled points look like lumen in {place}", count.like_lumen, count.of)
        };
        let others: Vec<String> = others.map(lumen_words).collect();
        let words = format!(
            "{} fit the volume; {}, but {}: read in {}",
            self.several(fitting),
            others.join(" and "),
            lumen_words(&(*best, *most)),
            best.unit.name(),
        );
        Some((best.unit, words))
    }

    fn space_by_values(&self, one: Reading, other: Reading, lumen: Lumen) -> Option<(Reading, String)> {
        let (of_one, of_other) = (lumen(one.place), lumen(other.place));
        let (best, other, count, few) = if of_one.is_evident_over(of_other) {
            (one, other, of_one, of_other)
        } else if of_other.is_evident_over(of_one) {
            (other, one, of_other, of_one)
        } else {
            return None;
        };
        let by_values = format!(
            "both {} ({} of {} points inside) and {} ({}) fit the volume; of {} sampled points, {} look like lumen in {} and \
             {} in {}: read in {}",
            best.place,
            best.inside,
            self.total,
            other.place,
            other.inside,
            count.of,
            count.like_lumen,
            best.place.space.name(),
            few.like_lumen,
            other.place.space.name(),
            best.place.space.name(),
        );
        Some((best, by_values))
    }

    fn nowhere(&self, spaces: &BTreeSet<&str>) -> Error {
        let spaces: Vec<&str> = spaces.iter().copied().collect();
        let units = Unit::ALL.into_iter().filter(|unit| self.readings.iter().any(|r| r.place.unit == *unit));
        let units: Vec<&str> = units.map(Unit::name).collect();
        let found =
            format!("no point inside the volume, in {}, in {}", spaces.join(" or "), units.join(", "));
        Error::new("", found, "centerlines of this volume").mended_by(Mend::Place)
    }

    fn undecided(&self, fitting: &[Reading]) -> Error {
        let units = units_of(fitting);
        let is_open = |space| self.readings.iter().any(|reading| reading.place.space == space);
        let mend = if units[..] == [self.usual.unit] {
            Mend::Coordinates
        } else if Space::ALL.into_iter().all(is_open) {
            Mend::Reading(fitting.iter().map(|reading| (reading.place.space, reading.place.unit)).collect())
        } else {
            Mend::Unit(units)
        };
        let found = "coordinates that are not stated and that the volume does not decide";
        Error::new("", format!("{found}: {}", self.several(fitting)), "a space and unit that fit")
            .mended_by(mend)
    }

    fn several(&self, fitting: &[Reading]) -> String {
        let is_usual = units_of(fitting)[..] == [self.usual.unit];
        let reading_words = |reading: &Reading| {
            let size = if is_usual { String::new() } else { format!(", {} across", mm(reading.across)) };
            format!("{} ({} of {} points inside{size})", reading.place, reading.inside, self.total)
        };
        fitting.iter().map(reading_words).collect::<Vec<_>>().join(", ")
    }

    pub(crate) fn confirmed_by(&self, best: Reading) -> Statement {
        let CoordinateSystem { space, unit } = best.place;
        Statement {
            space: (space != self.usual.space).then_some(space),
            unit: (unit != self.usual.unit).then_some(unit),
        }
    }

    pub(crate) fn decision_words(&self, best: Reading) -> String {
        if best.place == self.usual {
            return self.usual_decision_words(best);
        }
        let usual = self.readings.iter().find(|reading| reading.place == self.usual);
        let inside = usual.map_or(0, |reading| reading.inside);
        // These lines lie inside the volume, but their size in the usual unit is implausible.
        let tiny = usual.filter(|usual| usual.inside > 0 && !usual.is_plausible);
        let size = |across| tiny.map_or(String::new(), |_| format!(", {} across", mm(across)));
        format!(
            "{inside} of {} points lie inside the volume in {}{}, but {} in {}{}: read so",
            self.total,
            self.usual,
            size(tiny.map_or(0.0, |usual| usual.across)),
            best.inside,
            best.place,
            size(best.across),
        )
    }

    fn usual_decision_words(&self, best: Reading) -> String {
        let others = self.readings.iter().filter(|reading| {
            reading.place.space != best.place.space && reading.place.unit == best.place.unit
        });
        let others: String =
            others.map(|reading| format!(", {} in {}", reading.inside, reading.place.space.name())).collect();
        let also = self
            .readings
            .iter()
            .filter(|reading| reading.place.unit != best.place.unit && reading.is_as_good_as(best.inside));
        let also: Vec<String> = also.map(|reading| reading.place.to_string()).collect();
        let doubt = match &also[..] {
            [] => String::new(),
            _ => format!(", but {} would fit too", also.join(" and ")),
        };
        let counts = format!("{} of {} points inside{others}", best.inside, self.total);
        format!("{} fits the volume ({counts}){doubt}", best.place)
    }
}

fn units_of(readings: &[Reading]) -> Vec<Unit> {
    Unit::ALL.into_iter().filter(|unit| readings.iter().any(|reading| reading.place.unit == *unit)).collect()
}
