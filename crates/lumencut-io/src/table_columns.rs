//! Determines the meaning of table columns from the header or from the number of columns.

use crate::error::{Error, Result, excerpt};
use crate::placed_points::PlacedBy;
use crate::poly_data::names_radius;
use crate::space::Space;
use crate::unit::Unit;

#[derive(Debug, PartialEq)]
pub(crate) struct Columns {
    pub count: usize,
    pub xyz: [usize; 3],
    /// Column of the radius, and the factor that converts it to the unit of the coordinates.
    pub radius: Option<(usize, f64)>,
    /// Column that separates lines, and whether its values are groups from VMTK's branch splitting.
    pub key: Option<(usize, bool)>,
    /// Column that states which points have a position.
    pub placed: Option<(usize, PlacedBy)>,
    pub unit: Option<Unit>,
    pub space: Option<Space>,
    pub notes: Vec<String>,
}

const RADIUS_NAMES: [&str; 4] = ["maximuminscribedsphereradius", "radius", "radii", "r"];
const DIAMETER_NAMES: [&str; 2] = ["diameter", "diam"];
/// Names of the column that separates lines, the most specific first. Blanks and punctuation are ignored.
const KEY_NAMES: [&str; 11] = [
    "line",
    "lineid",
    "centerlineid",
    "centerlineids",
    "vessel",
    "vesselid",
    "vesselname",
    "branch",
    "branchid",
    "groupid",
    "groupids",
];
/// Names of the column with the position status, as in 3D Slicer.
const PLACED_NAMES: [(&str, PlacedBy); 2] =
    [("positionstatus", PlacedBy::Status), ("defined", PlacedBy::Flag)];
/// Prefixes in front of the name or number of an axis.
const POINT_PREFIXES: [&str; 6] = ["points:", "points_", "point_", "position_", "pos_", "coordinate_"];
const EXPECTED: &str =
    "numbers, or a header that names x, y, z (or L, P, S; R, A, S; Points:0, Points:1, Points:2)";

struct Name {
    base: String,
    unit: Option<String>,
}

impl Name {
    /// Splits a name such as `x (cm)`, `x [cm]`, `x_cm` or `x cm` into x and the unit cm.
    fn of(field: &str) -> Self {
        let field = field.trim().to_lowercase();
        if let Some((base, unit)) = field.split_once(['(', '[']) {
            let unit = unit.trim_end_matches([')', ']', ' ']).trim();
            return Self { base: base.trim().into(), unit: (!unit.is_empty()).then(|| unit.into()) };
        }
        match field.rsplit_once(['_', ' ']) {
            // A name that ends in `_m` may mean something other than metres.
            Some((base, unit)) if unit.len() > 1 && Unit::of_name(unit).is_some() => {
                Self { base: base.trim().into(), unit: Some(unit.into()) }
            }
            _ => Self { base: field, unit: None },
        }
    }

    /// Name without its prefix, such as x for `points:0`.
    fn axis(&self) -> &str {
        let stripped = POINT_PREFIXES.iter().find_map(|prefix| self.base.strip_prefix(prefix));
        match stripped.unwrap_or(&self.base) {
            "0" if stripped.is_some() => "x",
            "1" if stripped.is_some() => "y",
            "2" if stripped.is_some() => "z",
            axis => axis,
        }
    }

    fn joined(&self) -> String {
        self.base.replace(['_', ' ', '-', '.'], "")
    }
}

impl Columns {
    pub(crate) fn of_header(line: usize, header: &str, fields: &[&str]) -> Result<Self> {
        let at = |error: Error| error.in_file(&format!("line {line}"));
        let names: Vec<Name> = fields.iter().map(|field| Name::of(field)).collect();
        let Some((xyz, space)) = coordinates(&names) else {
            return Err(Error::new(format!("line {line}"), excerpt(header), EXPECTED));
        };
        if let Some(axis) = ["x", "y", "z"].into_iter().find(|axis| is_twice(&names, axis)) {
            let found = format!("more than one column {axis}, {}", excerpt(header));
            let error = Error::new(format!("line {line}"), found, "one column each for x, y and z");
            return Err(error.mend("remove the columns that are not coordinates"));
        }
        let units = xyz.map(|column| unit(fields[column], &names[column]));
        let [x, y, z] = units;
        let (x, y, z) = (x.map_err(at)?, y.map_err(at)?, z.map_err(at)?);
        if x != y || y != z {
            return Err(at(Error::new(
                "units of the coordinates",
                excerpt(header),
                "one unit for all three",
            )));
        }
        let key_of = |wanted: &&str| names.iter().position(|name| name.joined() == **wanted);
        let key = KEY_NAMES.iter().find_map(|name| Some((key_of(name)?, name.starts_with("group"))));
        let placed_by = |(name, by): (&str, PlacedBy)| Some((key_of(&name)?, by));
        let placed = PLACED_NAMES.into_iter().find_map(placed_by);
        let (count, notes) = (fields.len(), Vec::new());
        let mut out = Self { count, xyz, radius: None, key, placed, unit: x, space, notes };
        out.find_radius(fields, &names).map_err(at)?;
        Ok(out)
    }

    pub(crate) fn of_count(line: usize, count: usize) -> Result<Self> {
        if !matches!(count, 3 | 4) {
            let found = format!("{count} column(s) of numbers without a header");
            return Err(Error::new(format!("line {line}"), found, "3 columns x, y, z, or 4 with the radius")
                .mend("name the columns in the first line"));
        }
        let radius = (count == 4).then_some((3, 1.0));
        let (xyz, notes) = ([0, 1, 2], Vec::new());
        Ok(Self { count, xyz, radius, key: None, placed: None, unit: None, space: None, notes })
    }

    /// Finds the column of radii, or otherwise of diameters, and its factor to the unit of the coordinates.
    fn find_radius(&mut self, fields: &[&str], names: &[Name]) -> Result<()> {
        let free = |column: &usize| !self.xyz.contains(column);
        let find = |fits: &dyn Fn(&str) -> bool| {
            (0..names.len()).filter(free).find(|column| fits(&names[*column].joined()))
        };
        let radius = RADIUS_NAMES
            .iter()
            .find_map(|name| find(&|column| column == *name))
            .or_else(|| find(&names_radius));
        let diameter = DIAMETER_NAMES
            .iter()
            .find_map(|name| find(&|column| column == *name))
            .or_else(|| find(&|column| column.contains("diameter")));
        let Some((column, part)) = radius.map(|c| (c, 1.0)).or_else(|| diameter.map(|c| (c, 0.5))) else {
            return Ok(());
        };
        let own = unit(fields[column], &names[column])?;
        let name = excerpt(fields[column]);
        self.notes.push(match part == 1.0 {
            true => format!("radius from the column {name}"),
            false => format!("radius from half the column {name}"),
        });
        if self.unit.is_none()
            && let Some(own) = own
        {
            self.notes.push(format!("only the column {name} states a unit ({}); taken for all", own.name()));
            self.unit = Some(own);
        }
        let factor = own.zip(self.unit).map_or(1.0, |(own, unit)| own.in_units_of(unit));
        self.radius = Some((column, part * factor));
        Ok(())
    }
}

pub(crate) fn name_coordinates(fields: &[&str]) -> bool {
    coordinates(&fields.iter().map(|field| Name::of(field)).collect::<Vec<_>>()).is_some()
}

fn is_twice(names: &[Name], axis: &str) -> bool {
    names.iter().filter(|name| name.axis() == axis).nth(1).is_some()
}

fn coordinates(names: &[Name]) -> Option<([usize; 3], Option<Space>)> {
    let of = |axes: [&str; 3]| {
        let [x, y, z] = axes.map(|axis| names.iter().position(|name| name.axis() == axis));
        Some([x?, y?, z?])
    };
    of(["x", "y", "z"])
        .map(|xyz| (xyz, None))
        .or_else(|| of(["l", "p", "s"]).map(|xyz| (xyz, Some(Space::Lps))))
        .or_else(|| of(["r", "a", "s"]).map(|xyz| (xyz, Some(Space::Ras))))
}

fn unit(field: &str, name: &Name) -> Result<Option<Unit>> {
    let Some(text) = &name.unit else { return Ok(None) };
    let unit = Unit::of_name(text);
    unit.map(Some).ok_or_else(|| {
        let subject = format!("unit of the column {}", excerpt(field));
        Error::new(subject, excerpt(text), "one of um, mm, cm, dm, m")
    })
}
