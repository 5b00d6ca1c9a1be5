//! Space and unit of centerlines: what the caller says, else what their file states, else what fits the volume, by its
//! extent or, between two spaces, by its values along the lines, else what is usual.
//!
//! Nothing is decided in silence: every choice that the file does not state comes with the counts behind it.

use std::collections::BTreeSet;

use glam::DVec3;
use lumencut_io::{Error, Result, Space, Unit};

use crate::extent::Extent;
use crate::lumen_points::LumenCount;
use crate::places::{Place, Reading, places, readings};

/// A place is as good as another if it brings at least this part of the other's points into the volume.
const AS_GOOD: f64 = 0.8;

/// What is known of the coordinates of a file before the volume is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Known {
    /// The space that the caller asks for.
    pub asked_space: Option<Space>,
    /// The unit that the caller asks for.
    pub asked_unit: Option<Unit>,
    /// The space that the file states.
    pub stated_space: Option<Space>,
    /// The unit that the file states.
    pub stated_unit: Option<Unit>,
    /// The unit that files of its format usually have.
    pub usual_unit: Unit,
}

/// Who says in which space or unit coordinates are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The caller.
    Asked,
    /// The file.
    Stated,
    /// The extent of the volume.
    Volume,
    /// The values of the volume along the lines.
    Values,
    /// Nobody.
    Assumed,
}

impl Origin {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Asked => "asked",
            Self::Stated => "stated",
            Self::Volume => "volume",
            Self::Values => "values",
            Self::Assumed => "assumed",
        }
    }

    fn of<T>(asked: Option<T>, stated: Option<T>) -> Self {
        match (asked, stated) {
            (Some(_), _) => Self::Asked,
            (None, Some(_)) => Self::Stated,
            (None, None) => Self::Assumed,
        }
    }

    /// The same, where the volume has decided what nobody said.
    fn decided(self) -> Self {
        if self == Self::Assumed { Self::Volume } else { self }
    }
}

/// How the coordinates of a file are to be understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placement {
    /// The space and unit in which they are read.
    pub place: Place,
    /// Who says the space.
    pub space_from: Origin,
    /// Who says the unit.
    pub unit_from: Origin,
    /// What was decided, and by what; empty where the file or the caller said everything.
    pub decision: String,
    /// Whether the volume decided against LPS or the usual unit, or the space by its values alone.
    pub is_unusual: bool,
}

/// What the volume can say.
#[derive(Clone, Copy)]
pub struct Judge<'a> {
    /// The space that it fills.
    pub extent: Extent,
    /// How many points look like lumen in it where they are read in a place.
    pub lumen: &'a dyn Fn(Place) -> LumenCount,
}

/// Decides how the points of a file, as they stand in it, are to be understood; without a volume by what is usual.
///
/// # Errors
/// An [`Error`] without the file's name where the volume is there to decide and cannot: several places fit it alike, or
/// none does.
pub fn placement(known: &Known, points: &[DVec3], volume: Option<&Judge>) -> Result<Placement> {
    let usual = known.usual();
    let space_from = Origin::of(known.asked_space, known.stated_space);
    let unit_from = Origin::of(known.asked_unit, known.stated_unit);
    let open = [("space", space_from), ("unit", unit_from)].into_iter();
    let open: Vec<&str> = open.filter(|(_, from)| *from == Origin::Assumed).map(|(what, _)| what).collect();
    let told = |place, space_from, unit_from, decision| Placement {
        place,
        space_from,
        unit_from,
        decision,
        is_unusual: place != usual,
    };
    if open.is_empty() {
        return Ok(told(usual, space_from, unit_from, known.overruled()));
    }
    let nothing = format!("the file states no {}", open.join(" and no "));
    if let Some(volume) = volume {
        let candidates = places(
            if space_from == Origin::Assumed { &Space::ALL } else { std::slice::from_ref(&usual.space) },
            if unit_from == Origin::Assumed { &Unit::ALL } else { std::slice::from_ref(&usual.unit) },
        );
        let readings = readings(points, &candidates, &volume.extent);
        let choice = Choice { readings, usual, total: points.len() };
        let found = choice.best(volume.lumen)?;
        if let Some(by_values) = found.by_values {
            let decision = format!("{nothing}; {by_values}");
            let placement = told(found.best.place, Origin::Values, unit_from.decided(), decision);
            return Ok(Placement { is_unusual: true, ..placement });
        }
        if found.best.inside > 0 {
            let decision = format!("{nothing}; {}", choice.told(found.best));
            return Ok(told(found.best.place, space_from.decided(), unit_from.decided(), decision));
        }
    }
    let decision = format!("{nothing}; {usual} is assumed");
    Ok(told(usual, space_from, unit_from, decision))
}

impl Known {
    /// The place that is taken where the volume does not speak against it.
    pub fn usual(&self) -> Place {
        Place {
            space: self.asked_space.or(self.stated_space).unwrap_or(Space::Lps),
            unit: self.asked_unit.or(self.stated_unit).unwrap_or(self.usual_unit),
        }
    }

    /// What the file states and the caller contradicts.
    fn overruled(&self) -> String {
        let names = [
            (self.stated_space.map(Space::name), self.asked_space.map(Space::name)),
            (self.stated_unit.map(Unit::name), self.asked_unit.map(Unit::name)),
        ];
        let overruled = names.into_iter().filter_map(|(stated, asked)| {
            let (stated, asked) = (stated?, asked?);
            (stated != asked).then(|| format!("the file states {stated}; read as {asked} as asked"))
        });
        overruled.collect::<Vec<_>>().join("; ")
    }
}

/// The choice of a place by the points that it brings into the volume.
struct Choice {
    readings: Vec<Reading>,
    usual: Place,
    /// How many points there are.
    total: usize,
}

/// The place that was chosen.
struct Chosen {
    best: Reading,
    /// Where the values of the volume have chosen: what they say.
    by_values: Option<String>,
}

impl Chosen {
    fn by_extent(best: Reading) -> Self {
        Self { best, by_values: None }
    }
}

impl Choice {
    /// The place that fits the volume; the usual one where the file states a space and none fits.
    fn best(&self, lumen: &dyn Fn(Place) -> LumenCount) -> Result<Chosen> {
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
             {} in {}: read in {}; {} confirms it",
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
            space_option(best.place.space),
        );
        Some(Chosen { best, by_values: Some(by_values) })
    }

    fn nowhere(&self, spaces: &BTreeSet<&str>) -> Error {
        let spaces: Vec<&str> = spaces.iter().copied().collect();
        let units = Unit::ALL.into_iter().filter(|unit| self.readings.iter().any(|r| r.place.unit == *unit));
        let units: Vec<&str> = units.map(Unit::name).collect();
        let found =
            format!("no point inside the volume, in {}, in {}", spaces.join(" or "), units.join(", "));
        Error::new("", found, "centerlines of this volume")
            .mend("give coordinates=\"lps\" or \"ras\" and the unit if the file belongs to this volume")
    }

    fn undecided(&self, fitting: &[Reading]) -> Error {
        let told = |reading: &Reading| {
            format!("{} ({} of {} points inside)", reading.place, reading.inside, self.total)
        };
        let several: Vec<String> = fitting.iter().map(told).collect();
        let mut options: BTreeSet<String> = fitting.iter().map(|r| space_option(r.place.space)).collect();
        if options.len() == 1 {
            options = fitting.iter().map(|r| unit_option(r.place.unit)).collect();
        }
        let options: Vec<String> = options.into_iter().collect();
        let found = "neither stated nor to be told by the volume what its coordinates are";
        Error::new("", format!("{found}: {}", several.join(", ")), "one that fits")
            .mend(format!("give {}", options.join(" or ")))
    }

    /// The choice in words, with the counts that it rests on.
    fn told(&self, best: Reading) -> String {
        if best.place == self.usual {
            return self.told_as_usual(best);
        }
        let usual = self.readings.iter().find(|reading| reading.place == self.usual);
        let mut options = Vec::new();
        if best.place.space != self.usual.space {
            options.push(space_option(best.place.space));
        }
        if best.place.unit != self.usual.unit {
            options.push(unit_option(best.place.unit));
        }
        format!(
            "{} of {} points lie inside the volume in {}, but {} in {}: read so; {} confirms it",
            usual.map_or(0, |reading| reading.inside),
            self.total,
            self.usual,
            best.inside,
            best.place,
            options.join(" and "),
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

fn space_option(space: Space) -> String {
    format!("coordinates=\"{}\"", space.name())
}

fn unit_option(unit: Unit) -> String {
    format!("unit=\"{}\"", unit.name())
}

#[cfg(test)]
#[path = "tests/placement.rs"]
mod tests;
