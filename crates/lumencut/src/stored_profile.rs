//! Converts a profile to plain columns, from which it can be restored exactly.

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_vessels::measure::parts::Parts;
use lumencut_vessels::measure::profile::{Profile, Source};
use lumencut_vessels::measure::tree_walls::PooledWall;
use lumencut_vessels::measure::wall_level::WallSource;

/// The columns, flags and sources of a profile.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredProfile {
    /// Columns with their names, in mm, LPS or the volume's unit. x, y and z of each point follow each other.
    pub columns: Vec<(String, Vec<f64>)>,
    /// The flags of each section.
    pub flags: Vec<u32>,
    /// The source of the point-spread width: kind and words.
    pub fwhm_source: (String, String),
    /// The source of the wall level: kind and numbers.
    pub wall_source: (String, Vec<f64>),
}

impl StoredProfile {
    /// The columns of a profile.
    pub fn of(profile: &Profile) -> Self {
        let mut profile = profile.clone();
        let columns = columns(&mut profile).map(|(name, column)| (name.to_owned(), column.stored()));
        Self {
            columns: columns.into(),
            flags: profile.flags,
            fwhm_source: stored_source(&profile.fwhm_source),
            wall_source: stored_wall(&profile.wall_source),
        }
    }

    /// Restores the profile from its columns; it is bit-identical.
    ///
    /// # Errors
    /// [`ErrorKind::Measuring`] for missing or inconsistent columns.
    pub fn profile(&self) -> Result<Profile> {
        let mut profile = empty();
        for (name, column) in columns(&mut profile) {
            let stored = self.columns.iter().find(|(other, _)| other == name);
            let (_, numbers) = stored.ok_or_else(|| damaged(format!("no column {name}")))?;
            column.filled(numbers).ok_or_else(|| damaged(format!("{} numbers as {name}", numbers.len())))?;
        }
        profile.flags.clone_from(&self.flags);
        profile.fwhm_source = restored_source(&self.fwhm_source)?;
        profile.wall_source = restored_wall(&self.wall_source)?;
        let sections = profile.arc_length.len();
        let lengths = lengths(&profile);
        if sections == 0 || lengths.iter().any(|length| *length != sections) {
            return Err(damaged(format!("columns of {sections} and other numbers of sections")));
        }
        Ok(profile)
    }
}

enum Column<'a> {
    Number(&'a mut f64),
    Numbers(&'a mut Vec<f64>),
    Pairs(&'a mut Vec<[f64; 2]>),
    Parts(&'a mut Vec<Parts>),
    Points(&'a mut Vec<DVec3>),
    PointPairs(&'a mut Vec<[DVec3; 2]>),
    Contours(&'a mut Vec<Vec<DVec3>>),
}

fn columns(profile: &mut Profile) -> [(&'static str, Column<'_>); 21] {
    [
        ("arc_length", Column::Numbers(&mut profile.arc_length)),
        ("diameter_min", Column::Numbers(&mut profile.diameter_min)),
        ("diameter_max", Column::Numbers(&mut profile.diameter_max)),
        ("area", Column::Numbers(&mut profile.area)),
        ("uncertainty", Column::Numbers(&mut profile.uncertainty)),
        ("uncertainty_parts", Column::Parts(&mut profile.uncertainty_parts)),
        ("wall", Column::Pairs(&mut profile.wall)),
        ("diameter_outer", Column::Pairs(&mut profile.diameter_outer)),
        ("bounds", Column::Pairs(&mut profile.bounds)),
        ("center", Column::Points(&mut profile.center)),
        ("normal", Column::Points(&mut profile.normal)),
        ("axes", Column::PointPairs(&mut profile.axes)),
        ("contour", Column::Contours(&mut profile.contour)),
        ("half_axes", Column::PointPairs(&mut profile.half_axes)),
        ("inscribed_radius", Column::Numbers(&mut profile.inscribed_radius)),
        ("levels", Column::Pairs(&mut profile.levels)),
        ("noise", Column::Number(&mut profile.noise)),
        ("fwhm", Column::Number(&mut profile.fwhm)),
        ("fwhm_deviation", Column::Number(&mut profile.fwhm_deviation)),
        ("on_vessel", Column::Points(&mut profile.on_vessel)),
        ("without_wall", Column::Pairs(&mut profile.without_wall)),
    ]
}

impl Column<'_> {
    fn stored(self) -> Vec<f64> {
        match self {
            Self::Number(number) => vec![*number],
            Self::Numbers(numbers) => numbers.clone(),
            Self::Pairs(pairs) => pairs.iter().flatten().copied().collect(),
            Self::Parts(parts) => parts.iter().flat_map(five).collect(),
            Self::Points(points) => flat(points),
            Self::PointPairs(pairs) => flat(pairs.as_flattened()),
            Self::Contours(lists) => {
                lists.iter().flat_map(|points| [vec![points.len() as f64], flat(points)].concat()).collect()
            }
        }
    }

    /// Replaces the content of the column; None if the number of values is wrong.
    fn filled(self, numbers: &[f64]) -> Option<()> {
        match self {
            Self::Number(number) => {
                let [one] = numbers else { return None };
                *number = *one;
            }
            Self::Numbers(all) => *all = numbers.to_vec(),
            Self::Pairs(pairs) => *pairs = groups::<_, 2>(numbers)?.to_vec(),
            Self::Parts(parts) => *parts = groups::<_, 5>(numbers)?.iter().map(parts_of).collect(),
            Self::Points(points) => *points = points_of(numbers)?,
            Self::PointPairs(pairs) => *pairs = groups::<_, 2>(&points_of(numbers)?)?.to_vec(),
            Self::Contours(lists) => *lists = lists_of(numbers)?,
        }
        Some(())
    }
}

fn flat(points: &[DVec3]) -> Vec<f64> {
    points.iter().flat_map(DVec3::to_array).collect()
}

fn five(parts: &Parts) -> [f64; 5] {
    [parts.noise, parts.point_spread, parts.wall, parts.lumen, parts.surroundings]
}

fn parts_of(numbers: &[f64; 5]) -> Parts {
    let [noise, point_spread, wall, lumen, surroundings] = *numbers;
    Parts { noise, point_spread, wall, lumen, surroundings }
}

fn groups<T, const N: usize>(values: &[T]) -> Option<&[[T; N]]> {
    let (groups, rest) = values.as_chunks::<N>();
    rest.is_empty().then_some(groups)
}

fn points_of(numbers: &[f64]) -> Option<Vec<DVec3>> {
    Some(groups::<_, 3>(numbers)?.iter().copied().map(DVec3::from_array).collect())
}

fn lists_of(mut numbers: &[f64]) -> Option<Vec<Vec<DVec3>>> {
    let mut lists = Vec::new();
    while let Some((count, after)) = numbers.split_first() {
        // A count that is fractional or too large is invalid.
        let length = 3 * whole(*count)?;
        lists.push(points_of(after.get(..length)?)?);
        numbers = &after[length..];
    }
    Some(lists)
}

fn whole(number: f64) -> Option<usize> {
    ((0.0..1e9).contains(&number) && number.fract() == 0.0).then_some(number as usize)
}

fn stored_source(source: &Source) -> (String, String) {
    let (name, words) = match source {
        Source::Given => ("given", ""),
        Source::Estimated { on } => ("estimated", on.as_str()),
        Source::Assumed { from } => ("assumed", from.as_str()),
    };
    (name.to_owned(), words.to_owned())
}

fn restored_source((name, words): &(String, String)) -> Result<Source> {
    match name.as_str() {
        "given" => Ok(Source::Given),
        "estimated" => Ok(Source::Estimated { on: words.clone() }),
        "assumed" => Ok(Source::Assumed { from: words.clone() }),
        _ => Err(damaged(format!("a point spread from '{name}'"))),
    }
}

fn stored_wall(source: &WallSource) -> (String, Vec<f64>) {
    let (name, numbers) = match source {
        WallSource::Hounsfield => ("hounsfield", vec![]),
        WallSource::Given(level) => ("given", level.to_vec()),
        WallSource::Pooled { given, by_others } => {
            let by_others = [by_others.level[0], by_others.level[1], by_others.vessels as f64];
            ("pooled", given.iter().flatten().copied().chain(by_others).collect())
        }
        WallSource::NotAsked => ("not asked", vec![]),
        WallSource::DarkLumen => ("dark lumen", vec![]),
        WallSource::OtherUnit => ("other unit", vec![]),
        WallSource::AsBright => ("as bright", vec![]),
    };
    (name.to_owned(), numbers)
}

fn restored_wall((name, numbers): &(String, Vec<f64>)) -> Result<WallSource> {
    let pooled = |given, level, vessels: f64| {
        let by_others = PooledWall { level, vessels: whole(vessels)? };
        Some(WallSource::Pooled { given, by_others })
    };
    let found = match (name.as_str(), numbers.as_slice()) {
        ("hounsfield", []) => Some(WallSource::Hounsfield),
        ("given", [level, deviation]) => Some(WallSource::Given([*level, *deviation])),
        ("pooled", [a, b, vessels]) => pooled(None, [*a, *b], *vessels),
        ("pooled", [given, deviation, a, b, vessels]) => {
            pooled(Some([*given, *deviation]), [*a, *b], *vessels)
        }
        ("not asked", []) => Some(WallSource::NotAsked),
        ("dark lumen", []) => Some(WallSource::DarkLumen),
        ("other unit", []) => Some(WallSource::OtherUnit),
        ("as bright", []) => Some(WallSource::AsBright),
        _ => None,
    };
    found.ok_or_else(|| damaged(format!("a wall from '{name}' with {} numbers", numbers.len())))
}

fn empty() -> Profile {
    Profile {
        arc_length: Vec::new(),
        diameter_min: Vec::new(),
        diameter_max: Vec::new(),
        area: Vec::new(),
        uncertainty: Vec::new(),
        uncertainty_parts: Vec::new(),
        wall: Vec::new(),
        diameter_outer: Vec::new(),
        bounds: Vec::new(),
        flags: Vec::new(),
        center: Vec::new(),
        normal: Vec::new(),
        axes: Vec::new(),
        contour: Vec::new(),
        half_axes: Vec::new(),
        inscribed_radius: Vec::new(),
        levels: Vec::new(),
        noise: f64::NAN,
        fwhm: f64::NAN,
        fwhm_deviation: f64::NAN,
        fwhm_source: Source::Given,
        wall_source: WallSource::NotAsked,
        on_vessel: Vec::new(),
        without_wall: Vec::new(),
    }
}

fn lengths(profile: &Profile) -> [usize; 18] {
    [
        profile.arc_length.len(),
        profile.diameter_min.len(),
        profile.diameter_max.len(),
        profile.area.len(),
        profile.uncertainty.len(),
        profile.uncertainty_parts.len(),
        profile.wall.len(),
        profile.diameter_outer.len(),
        profile.bounds.len(),
        profile.flags.len(),
        profile.center.len(),
        profile.normal.len(),
        profile.axes.len(),
        profile.contour.len(),
        profile.half_axes.len(),
        profile.inscribed_radius.len(),
        profile.levels.len(),
        profile.on_vessel.len(),
    ]
}

fn damaged(found: String) -> Error {
    Error::new(ErrorKind::Measuring, "stored profile", found, "the columns of one profile")
}

#[cfg(test)]
#[path = "tests/stored_profile.rs"]
mod tests;
