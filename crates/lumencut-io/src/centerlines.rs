//! The content of a centerline file, and its checks.

use glam::DVec3;

use crate::error::{Error, Result};
use crate::space::Space;
use crate::unit::Unit;

/// One polyline of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Points in the file's space and unit: at least two, finite, no equal neighbours.
    pub points: Vec<DVec3>,
    /// Radius per point in the unit of the points, finite and ≥ 0; 0 where not stated. None if the file has
    /// none.
    pub radius: Option<Vec<f64>>,
    /// Group from a branch splitter; lines of one group run along the same vessel.
    pub group: Option<i64>,
    /// Name in the file.
    pub name: Option<String>,
    /// Confidence per point (0 to 1) of a traced line; written, not read.
    pub confidence: Option<Vec<f64>>,
    /// Number of the point list that was split into this line and others at its jumps.
    pub list: Option<usize>,
}

/// The lines of one file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Centerlines {
    /// Lines in file order, at least one.
    pub lines: Vec<Line>,
    /// Space stated by the file.
    pub space: Option<Space>,
    /// Unit stated by the file or its format, unchanged by [`scaled`](Self::scaled).
    pub unit: Option<Unit>,
    /// Usual unit of the format.
    pub conventional_unit: Option<Unit>,
    /// Name of the format, such as "VTK XML PolyData".
    pub format: &'static str,
    /// Whether the file states that its lines are separate vessels, so that none are joined.
    pub joined: bool,
    /// Notes for the user, one sentence each.
    pub notes: Vec<String>,
}

/// Mark in files of this crate whose lines are already vessels.
pub(crate) const JOINED_MARK: &str = "LumencutVessels";

/// Largest plausible coordinate or radius (mm); anything larger is damaged or misread data. The core uses the
/// same limit.
const LARGEST_COORDINATE: f64 = 1e6;

pub(crate) struct Limit {
    largest: f64,
    unit: &'static str,
}

impl Limit {
    /// Without a known unit, the limit of the smallest unit.
    pub(crate) fn of(unit: Option<Unit>) -> Self {
        let assumed = unit.unwrap_or(Unit::Micrometre);
        Self { largest: LARGEST_COORDINATE / assumed.in_mm(), unit: unit.map_or("", Unit::name) }
    }

    fn text(&self) -> String {
        format!("{:e} {}", self.largest, self.unit).trim_end().to_owned()
    }
}

impl Centerlines {
    /// Empty, in mm.
    pub(crate) fn of(format: &'static str) -> Self {
        Self { format, conventional_unit: Some(Unit::Millimetre), ..Self::default() }
    }

    pub(crate) fn note_once(&mut self, note: String) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Treats NaN radii as unknown and notes their number: 0 for single points, None for a whole line.
    fn without_nan_radii(mut self) -> Self {
        let (mut unknown, mut all) = (0, 0);
        for line in &mut self.lines {
            let nan = line.radius.iter().flatten().filter(|radius| radius.is_nan()).count();
            line.radius = line.radius.take().filter(|radius| nan < radius.len());
            let Some(radius) = &mut line.radius else { continue };
            all += radius.len();
            unknown += nan;
            radius.iter_mut().filter(|radius| radius.is_nan()).for_each(|radius| *radius = 0.0);
        }
        if unknown > 0 {
            self.notes.push(format!("{unknown} of {all} radii are missing"));
        }
        self
    }

    /// Treats radii that are all 0 as missing, because some programs write them so.
    pub(crate) fn without_zero_radii(self) -> Self {
        let mut zero = self.without_nan_radii();
        zero.drop_zero_radii();
        zero
    }

    fn drop_zero_radii(&mut self) {
        let mut radii = self.lines.iter().filter_map(|line| line.radius.as_ref()).flatten().peekable();
        if radii.peek().is_some() && radii.all(|radius| *radius == 0.0) {
            self.lines.iter_mut().for_each(|line| line.radius = None);
            self.notes.push("every radius is 0: taken as missing".into());
        }
    }

    /// Notes that unnamed numbers may be voxel indices, or something other than a radius.
    pub(crate) fn doubt_unnamed_columns(&mut self) {
        let mut numbers = self.lines.iter().flat_map(|line| &line.points).flat_map(|p| p.to_array());
        if numbers.all(|number| number.fract() == 0.0) {
            self.note_once("all coordinates are integers: these may be voxel indices instead of mm".into());
        }
        let mut radii = self.lines.iter().filter_map(|line| line.radius.as_ref()).flatten();
        if let Some(first) = radii.next() {
            let same =
                if radii.all(|r| r == first) { format!(" ({first} everywhere)") } else { String::new() };
            self.note_once(format!("radius from the unnamed fourth column{same}"));
        }
    }

    /// Checks every line; drops and notes repeated points and lines of one point.
    pub(crate) fn tidy(self) -> Result<Self> {
        let limit = Limit::of(self.unit);
        let mut out = self.without_nan_radii().checked(&limit)?;
        match out.lines.iter().filter(|line| line.radius.is_none()).count() {
            0 => {}
            n if n == out.lines.len() => out.notes.push("no radius in the file".into()),
            n => out.notes.push(format!("{n} of {} lines have no radius", out.lines.len())),
        }
        Ok(out)
    }

    /// Multiplies points and radii by `factor`, which converts them to mm as
    /// [`junctions::vessels`](crate::junctions::vessels) requires. Fails for an invalid factor, or a result
    /// beyond 1e6 mm.
    pub fn scaled(mut self, factor: f64) -> Result<Self> {
        if !(factor > 0.0 && factor.is_finite()) {
            return Err(Error::new("scale", format!("{factor}"), "a finite factor above 0"));
        }
        for line in &mut self.lines {
            line.points.iter_mut().for_each(|p| *p *= factor);
            line.radius.iter_mut().flatten().for_each(|r| *r *= factor);
        }
        self.checked(&Limit::of(Some(Unit::Millimetre)))
    }

    fn checked(mut self, limit: &Limit) -> Result<Self> {
        let found = self.lines.len();
        let mut repeated = 0;
        for (index, line) in self.lines.iter_mut().enumerate() {
            check(line, index, limit)?;
            repeated += drop_repeated_points(line);
        }
        self.lines.retain(|line| line.points.len() >= 2);
        if self.lines.is_empty() {
            let found = match found {
                0 => "no line".into(),
                n => format!("{n} line(s) with a single distinct point"),
            };
            return Err(Error::new("lines", found, "at least one line of two or more points"));
        }
        let dropped = found - self.lines.len();
        if dropped > 0 {
            self.notes.push(format!("{dropped} line(s) of fewer than two different points were dropped"));
        }
        if repeated > 0 {
            self.notes.push(format!("{repeated} point(s) equal to the one before were dropped"));
        }
        Ok(self)
    }
}

pub(crate) fn check(line: &Line, index: usize, limit: &Limit) -> Result<()> {
    let is_far = |p: &DVec3| p.is_nan() || p.abs().max_element() > limit.largest;
    if let Some(i) = line.points.iter().position(is_far) {
        let found = format!("{} at point {i}", line.points[i]);
        let expected = format!("coordinates of at most {}", limit.text());
        return Err(Error::new(format!("points of line {index}"), found, expected));
    }
    let Some(radius) = &line.radius else { return Ok(()) };
    match radius.iter().position(|r| !(0.0..=limit.largest).contains(r)) {
        None => Ok(()),
        Some(i) => {
            let found = format!("{} at point {i}", radius[i]);
            let expected = format!("radii from 0 to {}", limit.text());
            Err(Error::new(format!("radius of line {index}"), found, expected))
        }
    }
}

fn drop_repeated_points(line: &mut Line) -> usize {
    let count = line.points.len();
    if let Some(radius) = &mut line.radius {
        let mut at = 0..count;
        radius.retain(|_| at.next().is_some_and(|i| i == 0 || line.points[i] != line.points[i - 1]));
    }
    line.points.dedup();
    count - line.points.len()
}
