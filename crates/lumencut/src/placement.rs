//! Decides space and unit of centerlines. The caller decides first, then the file, then the volume. The volume decides by its
//! extent, or between two spaces by its values. If nothing decides, the usual space and unit are used. Every choice that the file
//! does not state is reported with the counts that led to it.

use glam::DVec3;
use lumencut_io::{Result, Space, Unit};

use crate::choice::{Choice, Chosen};
use crate::doubted_unit::{Doubt, doubted_unit};
pub use crate::lumen_points::Judge;
use crate::places::{CoordinateSystem, Statement, places, readings};

/// What is known about coordinates before the volume is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Known {
    /// The space requested by the caller.
    pub asked_space: Option<Space>,
    /// The unit requested by the caller.
    pub asked_unit: Option<Unit>,
    /// The space stated by the file.
    pub stated_space: Option<Space>,
    /// The unit stated by the file.
    pub stated_unit: Option<Unit>,
    /// The usual unit of the file format.
    pub usual_unit: Unit,
}

/// The source of a space or unit.
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
    /// The usual space or unit was assumed.
    Assumed,
}

impl Origin {
    /// The name of the source in reports.
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

    fn decided(self) -> Self {
        if self == Self::Assumed { Self::Volume } else { self }
    }
}

/// The space and unit in which the coordinates of a file are read, and the reasons.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placement {
    /// Space and unit.
    pub place: CoordinateSystem,
    /// The source of the space.
    pub space_from: Origin,
    /// The source of the unit.
    pub unit_from: Origin,
    /// The decision and its reason; empty if file or caller stated both space and unit.
    pub decision: String,
    /// What the caller can state in order to confirm what the volume decided.
    pub confirmed_by: Statement,
    /// Whether the volume decided against LPS or the usual unit, or only its values decided the space.
    pub is_unusual: bool,
    /// Other units that fit, if the volume decided for the usual unit.
    pub also: Vec<Unit>,
    /// Evidence against the stated or assumed unit.
    pub doubt: Option<Doubt>,
}

/// Decides how to read the points of a file. Without a volume, unstated space and unit are the usual ones. Fails with
/// [`lumencut_io::Error`], still without file name, if the volume cannot decide: several combinations fit equally, or
/// none fits.
pub fn placement(known: &Known, points: &[DVec3], volume: Option<&Judge>) -> Result<Placement> {
    let usual = known.usual();
    let space_from = Origin::of(known.asked_space, known.stated_space);
    let unit_from = Origin::of(known.asked_unit, known.stated_unit);
    let open = [("space", space_from), ("unit", unit_from)].into_iter();
    let open: Vec<&str> = open.filter(|(_, from)| *from == Origin::Assumed).map(|(what, _)| what).collect();
    let placed = |place, space_from, unit_from, decision| Placement {
        place,
        space_from,
        unit_from,
        decision,
        confirmed_by: Statement::default(),
        is_unusual: place != usual,
        also: Vec::new(),
        doubt: match unit_from {
            Origin::Stated | Origin::Assumed => doubted_unit(points, place, volume),
            Origin::Asked | Origin::Volume | Origin::Values => None,
        },
    };
    if open.is_empty() {
        return Ok(placed(usual, space_from, unit_from, known.overruled()));
    }
    let nothing = format!("the file states no {}", open.join(" and no "));
    if let Some(volume) = volume {
        let candidates = places(
            if space_from == Origin::Assumed { &Space::ALL } else { std::slice::from_ref(&usual.space) },
            if unit_from == Origin::Assumed { &Unit::ALL } else { std::slice::from_ref(&usual.unit) },
        );
        let readings = readings(points, &candidates, &volume.extent);
        let choice = Choice { readings, usual, total: points.len() };
        let Chosen { best, by_values, also } = choice.best(volume.lumen)?;
        let mut confirmed_by = choice.confirmed_by(best);
        if let Some(by_values) = by_values {
            let from = |is_chosen, from: Origin| if is_chosen { Origin::Values } else { from.decided() };
            let froms = [from(by_values.space, space_from), from(by_values.unit, unit_from)];
            let placement = placed(best.place, froms[0], froms[1], format!("{nothing}; {}", by_values.words));
            confirmed_by.space = confirmed_by.space.or(by_values.space.then_some(best.place.space));
            return Ok(Placement { is_unusual: true, confirmed_by, also, ..placement });
        }
        if best.inside > 0 {
            let decision = format!("{nothing}; {}", choice.decision_words(best));
            let placement = placed(best.place, space_from.decided(), unit_from.decided(), decision);
            return Ok(Placement { confirmed_by, also, ..placement });
        }
    }
    let decision = format!("{nothing}; {usual} is assumed");
    Ok(placed(usual, space_from, unit_from, decision))
}

impl Known {
    /// The space and unit that are used unless the volume contradicts them.
    pub fn usual(&self) -> CoordinateSystem {
        CoordinateSystem {
            space: self.asked_space.or(self.stated_space).unwrap_or(Space::Lps),
            unit: self.asked_unit.or(self.stated_unit).unwrap_or(self.usual_unit),
        }
    }

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

#[cfg(test)]
#[path = "tests/placement.rs"]
mod tests;
