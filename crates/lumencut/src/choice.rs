//! The choice among the spaces and units of centerlines, and the counts behind it in words.

use std::collections::BTreeSet;

use lumencut_io::{Error, Mend, Result, Space, Unit};

use crate::lumen_points::LumenCount;
use crate::places::{Place, Reading, Statement};

/// A place is as good as another if it brings at least this part of the other's points into the volume.
const AS_GOOD: f64 = 0.8;

/// The choice of a place by the points that it brings into the volume.
pub struct Choice {
    /// What each place makes of the points.
    pub readings: Vec<Reading>,
    /// The place that is taken where the volume does not speak against it.
    pub usual: Place,
    /// How many points there are.
    pub total: usize,
}

/// The place that was chosen.
pub struct Chosen {
    /// The place, and how many points it brings into the volume.
    pub best: Reading,
    /// Where the values of the volume have chosen: what they say.
    pub by_values: Option<String>,
}

impl Chosen {
    fn by_extent(best: Reading) -> Self {
        Self { best, by_values: None }
    }
}

impl Choice {
    /// The place that fits the volume; the usual one where the file states a space and none fits.
    pub fn best(&self, lumen: &dyn Fn(Place) -> LumenCount) -> Result<Chosen> {
        let most = self.readings.iter().map(|reading| reading.inside).max().unwrap_or(0);
        let spaces: BTreeSet<&str> = self.readings.iter().map(|reading| reading.place.space.name()).collect();
        if most == 0 && spaces.len() == 1 {
            return Ok(Chosen::by_extent(Reading { place: self.usual, inside: 0 }));
        }
        if most == 0 {
            return Err(self.nowhere(&spaces));
        }
        let fitting: Vec<Reading> =
            self.readings.iter().filter(|reading| reading.is_as_good_as(most)).copied().collect();
        // Another unit is only thought of where the usual one does not fit.
        let usual: Vec<Reading> =
            fitting.iter().filter(|reading| reading.place.unit == self.usual.unit).copied().collect();
        let fitting = if usual.is_empty() { fitting } else { usual };
        match fitting[..] {
            [only] => Ok(Chosen::by_extent(only)),
            [one, other] if one.place.unit == other.place.unit => {
                self.by_values(one, other, lumen).ok_or_else(|| self.undecided(&fitting))
            }
            _ => Err(self.undecided(&fitting)),
        }
    }

    /// The one of two spaces in which the points look like lumen, where that is evident.
    fn by_values(&self, one: Reading, other: Reading, lumen: &dyn Fn(Place) -> LumenCount) -> Option<Chosen> {
        let (of_one, of_other) = (lumen(one.place), lumen(other.place));
        let (best, other, count, few) = if of_one.is_evident_beside(of_other) {
            (one, other, of_one, of_other)
        } else if of_other.is_evident_beside(of_one) {
            (other, one, of_other, of_one)
        } else {
            return None;
        };
        let by_values = format!(
            "both {} ({} of {} points inside) and {} ({}) fit the volume; of {} points looked at, {} look like lumen in {} and \
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
        Some(Chosen { best, by_values: Some(by_values) })
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
        let told = |reading: &Reading| {
            format!("{} ({} of {} points inside)", reading.place, reading.inside, self.total)
        };
        let several: Vec<String> = fitting.iter().map(told).collect();
        let fits = |space| fitting.iter().any(|reading| reading.place.space == space);
        let mend = if Space::ALL.into_iter().all(fits) {
            Mend::Coordinates
        } else {
            Mend::Unit(fitting.iter().map(|reading| reading.place.unit).collect())
        };
        let found = "neither stated nor to be told by the volume what its coordinates are";
        Error::new("", format!("{found}: {}", several.join(", ")), "one that fits").mended_by(mend)
    }

    /// What the caller would state to confirm a choice against the usual place.
    pub fn confirmed_by(&self, best: Reading) -> Statement {
        let Place { space, unit } = best.place;
        Statement {
            space: (space != self.usual.space).then_some(space),
            unit: (unit != self.usual.unit).then_some(unit),
        }
    }

    /// The choice in words, with the counts that it rests on.
    pub fn told(&self, best: Reading) -> String {
        if best.place == self.usual {
            return self.told_as_usual(best);
        }
        let usual = self.readings.iter().find(|reading| reading.place == self.usual);
        format!(
            "{} of {} points lie inside the volume in {}, but {} in {}: read so",
            usual.map_or(0, |reading| reading.inside),
            self.total,
            self.usual,
            best.inside,
            best.place,
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

impl Reading {
    pub(crate) fn is_as_good_as(&self, inside: usize) -> bool {
        self.inside as f64 >= AS_GOOD * inside as f64
    }
}
