//! The content of a VTK poly data file, and its conversion to centerlines.

use glam::DVec3;

use crate::centerlines::{Centerlines, Line};
use crate::data_array;
use crate::error::{Error, Result};
use crate::space::Space;

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Array {
    pub name: String,
    /// Number of values per point or cell.
    pub components: usize,
    pub values: Vec<f64>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct PolyData {
    /// x, y and z of each point.
    pub points: Vec<f64>,
    /// Ids of the points of all lines.
    pub connectivity: Vec<f64>,
    /// Position in `connectivity` at which each line ends.
    pub ends: Vec<f64>,
    pub cells_before_lines: usize,
    pub other_cells: usize,
    pub point_arrays: Vec<Array>,
    pub cell_arrays: Vec<Array>,
    pub names: Option<Vec<String>>,
}

/// Name of the cell array that holds names.
pub(crate) const NAMES: &str = "Name";
/// Name of the cell array that is 0 for cells without a name.
pub(crate) const HAS_NAME: &str = "HasName";
/// Name of the cell array that is 0 for lines without radii.
pub(crate) const HAS_RADIUS: &str = "HasRadius";
/// Names of point arrays that hold radii, the most specific first.
pub(crate) const RADIUS_NAMES: [&str; 4] =
    ["MaximumInscribedSphereRadius", "Radius", "Radii", "VesselRadius"];
const GROUP_NAME: &str = "GroupIds";

pub(crate) fn wanted(name: &str) -> bool {
    name == GROUP_NAME || [HAS_NAME, HAS_RADIUS].contains(&name) || names_radius(name) || names_diameter(name)
}

/// Whether an array with this name holds radii; radii of curvature are excluded.
pub(crate) fn names_radius(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    ["radius", "radii"].iter().any(|word| name.contains(word)) && !name.contains("curvature")
}

pub(crate) fn space_of(text: &str) -> Option<Space> {
    match text.trim().trim_matches('\0').to_ascii_uppercase().as_str() {
        "LPS" => Some(Space::Lps),
        "RAS" => Some(Space::Ras),
        _ => None,
    }
}

fn names_diameter(name: &str) -> bool {
    name.to_ascii_lowercase().contains("diameter")
}

impl PolyData {
    pub(crate) fn into_centerlines(self, out: &mut Centerlines) -> Result<()> {
        let (points, rest) = self.points.as_chunks::<3>();
        if !rest.is_empty() {
            return Err(Error::new("points", format!("{} coordinates", self.points.len()), "3 per point"));
        }
        if self.ends.is_empty() && !points.is_empty() {
            let found = format!("{} point(s), {} other cell(s) but no line", points.len(), self.other_cells);
            return Err(Error::new("lines", found, "at least one line through the points")
                .mend("give a file of centerlines, not of points or surfaces"));
        }
        let radius = self.radius(points.len(), &mut out.notes)?;
        let groups = self.groups(points.len())?;
        let (has_radius, has_name) = (self.of_lines(HAS_RADIUS)?, self.of_lines(HAS_NAME)?);
        let says = |has: Option<&[f64]>, cell: usize| has.is_none_or(|has| has[cell] != 0.0);
        let names =
            self.names.as_ref().map(|names| self.lines_of(NAMES, names)).transpose()?.unwrap_or_default();
        out.lines.reserve(self.ends.len());
        let mut start = 0;
        for (cell, end) in self.ends.iter().enumerate() {
            let end = data_array::index("offsets of the lines", *end, self.connectivity.len() + 1)?;
            let ids = self.connectivity.get(start..end).ok_or_else(|| {
                Error::new(
                    "offsets of the lines",
                    format!("{end} after {start}"),
                    "offsets that never decrease",
                )
            })?;
            start = end;
            let index = |id: &f64| data_array::index("point ids of the lines", *id, points.len());
            let ids = ids.iter().map(index).collect::<Result<Vec<_>>>()?;
            let radius = radius.filter(|_| says(has_radius, cell));
            let line = |ids: &[usize], group| Line {
                points: ids.iter().map(|i| DVec3::from(points[*i])).collect(),
                radius: radius.map(|(r, part)| ids.iter().map(|i| r[*i] * part).collect()),
                group,
                name: names.get(cell).filter(|_| says(has_name, cell)).cloned(),
                ..Line::default()
            };
            match &groups {
                Groups::None => out.lines.push(line(&ids, None)),
                Groups::OfLines(groups) => out.lines.push(line(&ids, Some(groups[cell] as i64))),
                Groups::OfPoints(groups) => {
                    out.lines.extend(runs(&ids, groups).map(|(run, group)| line(run, Some(group))));
                }
            }
        }
        Ok(())
    }

    /// Values of the best array of radii, else of diameters, and the factor that converts them to radii.
    fn radius(&self, points: usize, notes: &mut Vec<String>) -> Result<Option<(&[f64], f64)>> {
        let scalar = |array: &&Array| array.components == 1;
        let named = RADIUS_NAMES.iter().find_map(|name| {
            self.point_arrays.iter().filter(scalar).find(|array| array.name.eq_ignore_ascii_case(name))
        });
        let like = || self.point_arrays.iter().filter(scalar).find(|array| names_radius(&array.name));
        let radius = named.or_else(like).map(|array| (array, 1.0, ""));
        let diameter = || {
            let array = self.point_arrays.iter().filter(scalar).find(|array| names_diameter(&array.name));
            array.map(|array| (array, 0.5, "half "))
        };
        let Some((array, part, half)) = radius.or_else(diameter) else { return Ok(None) };
        one_value_each(array, points, "point")?;
        let note = format!("radius from {half}the point array '{}'", array.name);
        if !notes.contains(&note) {
            notes.push(note);
        }
        Ok(Some((&array.values, part)))
    }

    fn groups(&self, points: usize) -> Result<Groups<'_>> {
        if let Some(values) = self.of_lines(GROUP_NAME)? {
            return Ok(Groups::OfLines(values));
        }
        let is_group = |array: &&Array| array.name == GROUP_NAME && array.components == 1;
        let Some(array) = self.point_arrays.iter().find(is_group) else { return Ok(Groups::None) };
        one_value_each(array, points, "point")?;
        Ok(Groups::OfPoints(&array.values))
    }

    fn of_lines(&self, name: &str) -> Result<Option<&[f64]>> {
        let array = self.cell_arrays.iter().find(|array| array.name == name && array.components == 1);
        array.map(|array| self.lines_of(name, &array.values)).transpose()
    }

    fn lines_of<'a, T>(&self, name: &str, values: &'a [T]) -> Result<&'a [T]> {
        let range = self.cells_before_lines..self.cells_before_lines.saturating_add(self.ends.len());
        values.get(range).ok_or_else(|| {
            let found = format!("{} values", values.len());
            let expected = format!("one per cell, of {} lines", self.ends.len());
            Error::new(format!("cell array '{name}'"), found, expected)
        })
    }
}

enum Groups<'a> {
    None,
    OfLines(&'a [f64]),
    OfPoints(&'a [f64]),
}

fn one_value_each(array: &Array, count: usize, of: &str) -> Result<()> {
    if array.values.len() == count {
        return Ok(());
    }
    let found = format!("{} values for {count} {of}s", array.values.len());
    Err(Error::new(format!("{of} array '{}'", array.name), found, format!("one value per {of}")))
}

/// Splits point ids into stretches of one group. A stretch starts with the last point of the one before it.
fn runs<'a>(ids: &'a [usize], groups: &'a [f64]) -> impl Iterator<Item = (&'a [usize], i64)> {
    let mut start = 0;
    std::iter::from_fn(move || {
        let group = groups[*ids.get(start)?];
        let length = ids[start..].iter().take_while(|id| groups[**id] == group).count();
        let begin = start.saturating_sub(1);
        start += length.max(1);
        Some((&ids[begin..start], group as i64))
    })
}
