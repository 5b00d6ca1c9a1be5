//! The choice among the spaces and units of centerlines, and the counts behind it in words.

use std::collections::BTreeSet;

use lumencut_io::{Error, Mend, Result, Space, Unit};

use crate::lumen_points::LumenCount;
use crate::places::{Place, Reading, Statement, mm};

/// Counts the points that look like lumen in a place.
type Lumen<'a> = &'a dyn Fn(Place) -> LumenCount;

/// The choice of a place by the points that it brings into the volume.
pub(crate) struct Choice {
    /// What each place makes of the points.
    pub(crate) readings: Vec<Reading>,
    /// The place that is taken where the volume does not speak against it.
    pub usual: Place,
    /// How many points there are.
    pub(crate) total: usize,
}

/// The place that was chosen.
pub(crate) struct Chosen {
    /// The place, and how many points it brings into the volume.
    pub(crate) best: Reading,
    /// Where the values of the volume have chosen the space or the unit: what they say.
    pub by_values: Option<ByValues>,
    /// The units that fit the volume too.
    pub also: Vec<Unit>,
}

/// What the values of a volume have chosen.
#[derive(Clone, Debug)]
pub(crate) struct ByValues {
    /// Whether they chose the space.
    pub space: bool,
    /// Whether they chose the unit, and not the usual one.
    pub unit: bool,
    /// What they say, in words.
    pub words: String,
}

/// Readings in one unit, and what led to it.
struct OfOneUnit {
    readings: Vec<Reading>,
    /// What the values say, where they chose.
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
    /// The place that fits the volume; the usual one where the file states a space and none fits.
    ///
    /// # Errors
    /// Where several places fit it alike and its values do not tell which, or none fits and the space is open.
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
                        // Where the space is asked for, so is the unit.
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

    /// The readings of the unit in which the points evidently look like lumen, else those of the usual one. Lines that are
    /// short in the usual unit are as likely in another.
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

    /// The unit in which the points look like lumen, where that is evident beside all others.
    fn unit_by_values(&self, fitting: &[Reading], lumen: Lumen) -> Option<(Unit, String)> {
        let counts: Vec<(Place, LumenCount)> =
            fitting.iter().map(|reading| (reading.place, lumen(reading.place))).collect();
        let (best, most) = counts.iter().max_by_key(|(_, count)| count.like_lumen)?;
        let others = counts.iter().filter(|(place, _)| place.unit != best.unit);
        if !others.clone().all(|(_, count)| most.is_evident_beside(*count)) {
            return None;
        }
        let told = |(place, count): &(Place, LumenCount)| {
            format!("{} of {} sampled points look like lumen in {place}", count.like_lumen, count.of)
        };
        let others: Vec<String> = others.map(told).collect();
        let words = format!(
            "{} fit the volume; {}, but {}: read in {}",
            self.several(fitting),
            others.join(" and "),
            told(&(*best, *most)),
            best.unit.name(),
        );
        Some((best.unit, words))
    }

    /// The one of two spaces in which the points look like lumen, where that is evident, and what the values say.
    fn space_by_values(&self, one: Reading, other: Reading, lumen: Lumen) -> Option<(Reading, String)> {
        let (of_one, of_other) = (lumen(one.place), lumen(other.place));
        let (best, other, count, few) = if of_one.is_evident_beside(of_other) {
            (one, other, of_one, of_other)
        } else if of_other.is_evident_beside(of_one) {
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
        Error::new("", format!("{found}: {}", self.several(fitting)), "one that fits").mended_by(mend)
    }

    /// Several readings with the counts behind them, and with their sizes where the unit is not the usual one.
    fn several(&self, fitting: &[Reading]) -> String {
        let is_usual = units_of(fitting)[..] == [self.usual.unit];
        let told = |reading: &Reading| {
            let size = if is_usual { String::new() } else { format!(", {} across", mm(reading.across)) };
            format!("{} ({} of {} points inside{size})", reading.place, reading.inside, self.total)
        };
        fitting.iter().map(told).collect::<Vec<_>>().join(", ")
    }

    /// What the caller would state to confirm a choice against the usual place.
    pub(crate) fn confirmed_by(&self, best: Reading) -> Statement {
        let Place { space, unit } = best.place;
        Statement {
            space: (space != self.usual.space).then_some(space),
            unit: (unit != self.usual.unit).then_some(unit),
        }
    }

    /// The choice in words, with the counts that it rests on.
    pub(crate) fn told(&self, best: Reading) -> String {
        if best.place == self.usual {
            return self.told_as_usual(best);
        }
        let usual = self.readings.iter().find(|reading| reading.place == self.usual);
        let inside = usual.map_or(0, |reading| reading.inside);
        // Lines that lie inside and have no size in the usual unit.
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

    fn told_as_usual(&self, best: Reading) -> String {
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

/// The units of readings, each once.
fn units_of(readings: &[Reading]) -> Vec<Unit> {
    Unit::ALL.into_iter().filter(|unit| readings.iter().any(|reading| reading.place.unit == *unit)).collect()
}
