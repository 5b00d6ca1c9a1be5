//! Space and unit of centerlines: what the caller says, else what their file states, else what fits the volume, by its
//! extent or, between two spaces, by its values along the lines, else what is usual.
//!
//! Nothing is decided in silence: every choice that the file does not state comes with the counts behind it.

use glam::DVec3;
use lumencut_io::{Result, Space, Unit};

use crate::choice::{Choice, Chosen};
use crate::doubted_unit::{Doubt, doubted_unit};
pub use crate::lumen_points::Judge;
use crate::places::{Place, Statement, places, readings};

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
    /// What the caller would state to confirm the decision of the volume; nothing where there is nothing to confirm.
    pub confirmed_by: Statement,
    /// Whether the volume decided against LPS or the usual unit, or the space by its values alone.
    pub is_unusual: bool,
    /// Units that would fit the volume too, where it decided for the usual one.
    pub also: Vec<Unit>,
    /// What speaks against the unit that the file states, or that was assumed.
    pub doubt: Option<Doubt>,
}

/// Decides how the points of a file, as they stand in it, are to be understood; without a volume by what is usual.
///
/// # Errors
/// An [`lumencut_io::Error`] without the file's name where the volume is there to decide and cannot: several places fit it alike, or
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
        confirmed_by: Statement::default(),
        is_unusual: place != usual,
        also: Vec::new(),
        doubt: match unit_from {
            Origin::Stated | Origin::Assumed => doubted_unit(points, place, volume),
            Origin::Asked | Origin::Volume | Origin::Values => None,
        },
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
        let Chosen { best, by_values, also } = choice.best(volume.lumen)?;
        let mut confirmed_by = choice.confirmed_by(best);
        if let Some(by_values) = by_values {
            let from = |is_chosen, from: Origin| if is_chosen { Origin::Values } else { from.decided() };
            let froms = [from(by_values.space, space_from), from(by_values.unit, unit_from)];
            let placement = told(best.place, froms[0], froms[1], format!("{nothing}; {}", by_values.words));
            confirmed_by.space = confirmed_by.space.or(by_values.space.then_some(best.place.space));
            return Ok(Placement { is_unusual: true, confirmed_by, also, ..placement });
        }
        if best.inside > 0 {
            let decision = format!("{nothing}; {}", choice.told(best));
            let placement = told(best.place, space_from.decided(), unit_from.decided(), decision);
            return Ok(Placement { confirmed_by, also, ..placement });
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

#[cfg(test)]
#[path = "tests/placement.rs"]
mod tests;
