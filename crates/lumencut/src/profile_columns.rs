//! Converts the columns of a profile to and from plain numbers.

use glam::DVec3;
use lumencut_vessels::measure::flap::found::Flap;
use lumencut_vessels::measure::outer::found::OuterWall;
use lumencut_vessels::measure::profile::{Profile, Source};
use lumencut_vessels::measure::uncertainty::Parts;
use lumencut_vessels::measure::wall::WallSource;

pub(crate) enum Column<'a> {
    Number(&'a mut f64),
    Numbers(&'a mut Vec<f64>),
    Pairs(&'a mut Vec<[f64; 2]>),
    Parts(&'a mut Vec<Parts>),
    Points(&'a mut Vec<DVec3>),
    PointPairs(&'a mut Vec<[DVec3; 2]>),
    Contours(&'a mut Vec<Vec<DVec3>>),
    OuterWalls(&'a mut Vec<OuterWall>),
    Flaps(&'a mut Vec<Flap>),
}

/// The columns of a profile by name, except its flags.
pub(crate) fn columns(profile: &mut Profile) -> [(&'static str, Column<'_>); 30] {
    [
        ("arc_length", Column::Numbers(&mut profile.arc_length)),
        ("diameter_min", Column::Numbers(&mut profile.diameter_min)),
        ("diameter_max", Column::Numbers(&mut profile.diameter_max)),
        ("area", Column::Numbers(&mut profile.area)),
        ("uncertainty", Column::Numbers(&mut profile.uncertainty)),
        ("uncertainty_parts", Column::Parts(&mut profile.uncertainty_parts)),
        ("wall", Column::Pairs(&mut profile.wall)),
        ("diameter_outer", Column::Pairs(&mut profile.diameter_outer)),
        ("outer_wall", Column::OuterWalls(&mut profile.outer_wall)),
        ("outer_contour", Column::Contours(&mut profile.outer_contour)),
        ("flap", Column::Flaps(&mut profile.flap)),
        ("own_lumen", Column::Contours(&mut profile.own_lumen)),
        ("other_lumen", Column::Contours(&mut profile.other_lumen)),
        ("area_own_lumen", Column::Pairs(&mut profile.area_own_lumen)),
        ("area_other_lumen", Column::Pairs(&mut profile.area_other_lumen)),
        ("bounds", Column::Pairs(&mut profile.bounds)),
        ("at_most", Column::Numbers(&mut profile.at_most)),
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
        ("line_values", Column::Numbers(&mut profile.line_values)),
        ("without_wall", Column::Pairs(&mut profile.without_wall)),
    ]
}

impl Column<'_> {
    pub(crate) fn stored(self) -> Vec<f64> {
        match self {
            Self::Number(number) => vec![*number],
            Self::Numbers(numbers) => numbers.clone(),
            Self::Pairs(pairs) => pairs.iter().flatten().copied().collect(),
            Self::Parts(parts) => parts.iter().flat_map(five).collect(),
            Self::Points(points) => flat(points),
            Self::PointPairs(pairs) => flat(pairs.as_flattened()),
            Self::OuterWalls(all) => all.iter().map(|one| *one as usize as f64).collect(),
            Self::Flaps(all) => all.iter().map(|one| *one as usize as f64).collect(),
            Self::Contours(lists) => {
                lists.iter().flat_map(|points| [vec![points.len() as f64], flat(points)].concat()).collect()
            }
        }
    }

    /// Replaces the content of the column; None if the number of values is wrong.
    pub(crate) fn filled(self, numbers: &[f64]) -> Option<()> {
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
            Self::OuterWalls(all) => {
                let known = |number: &f64| OuterWall::ALL.get(whole(*number)?).copied();
                *all = numbers.iter().map(known).collect::<Option<_>>()?;
            }
            Self::Flaps(all) => {
                let known = |number: &f64| Flap::ALL.get(whole(*number)?).copied();
                *all = numbers.iter().map(known).collect::<Option<_>>()?;
            }
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

pub(crate) fn parts_of(numbers: &[f64; 5]) -> Parts {
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
        let length = 3 * whole(*count)?;
        lists.push(points_of(after.get(..length)?)?);
        numbers = &after[length..];
    }
    Some(lists)
}

/// The number as a count; None if it is fractional, negative or too large.
pub(crate) fn whole(number: f64) -> Option<usize> {
    ((0.0..1e9).contains(&number) && number.fract() == 0.0).then_some(number as usize)
}

pub(crate) fn empty() -> Profile {
    Profile {
        arc_length: Vec::new(),
        diameter_min: Vec::new(),
        diameter_max: Vec::new(),
        area: Vec::new(),
        uncertainty: Vec::new(),
        uncertainty_parts: Vec::new(),
        wall: Vec::new(),
        diameter_outer: Vec::new(),
        outer_wall: Vec::new(),
        outer_contour: Vec::new(),
        flap: Vec::new(),
        own_lumen: Vec::new(),
        other_lumen: Vec::new(),
        area_own_lumen: Vec::new(),
        area_other_lumen: Vec::new(),
        bounds: Vec::new(),
        at_most: Vec::new(),
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
        line_values: Vec::new(),
        without_wall: Vec::new(),
    }
}

/// The numbers of sections of all columns, which are equal in a profile.
pub(crate) fn lengths(profile: &Profile) -> [usize; 27] {
    [
        profile.arc_length.len(),
        profile.diameter_min.len(),
        profile.diameter_max.len(),
        profile.area.len(),
        profile.uncertainty.len(),
        profile.uncertainty_parts.len(),
        profile.wall.len(),
        profile.diameter_outer.len(),
        profile.outer_wall.len(),
        profile.outer_contour.len(),
        profile.flap.len(),
        profile.own_lumen.len(),
        profile.other_lumen.len(),
        profile.area_own_lumen.len(),
        profile.area_other_lumen.len(),
        profile.bounds.len(),
        profile.at_most.len(),
        profile.flags.len(),
        profile.center.len(),
        profile.normal.len(),
        profile.axes.len(),
        profile.contour.len(),
        profile.half_axes.len(),
        profile.inscribed_radius.len(),
        profile.levels.len(),
        profile.on_vessel.len(),
        profile.line_values.len(),
    ]
}
