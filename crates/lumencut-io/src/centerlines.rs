//! The content of a centerline file, and checks of it.

use glam::DVec3;

use crate::error::{Error, Result};
use crate::space::Space;
use crate::unit::Unit;

/// One polyline of a file, with its radii and names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Points in the space and unit of the file: at least two, all finite; neighbours are never equal.
    pub points: Vec<DVec3>,
    /// Radius of each point in the unit of the points, finite and ≥ 0; 0 if not stated. None if the file has
    /// no radii for this line.
    pub radius: Option<Vec<f64>>,
    /// Group number from VMTK's branch splitting; lines of one group run along the same vessel.
    pub group: Option<i64>,
    /// Name of the line in the file.
    pub name: Option<String>,
    /// Confidence of each point (0 to 1) of a traced line. It is written, but not read.
    pub confidence: Option<Vec<f64>>,
    /// Whether a reader moved each point by hand. It is written, but not read.
    pub by_hand: Option<Vec<bool>>,
    /// Number of the point list from which this line was cut, if the list was split at long jumps.
    pub list: Option<usize>,
}

/// The lines of one file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Centerlines {
    /// Lines in the order of the file, at least one.
    pub lines: Vec<Line>,
    /// Space that the file states.
    pub space: Option<Space>,
    /// Unit that the file or its format states; [`scaled`](Self::scaled) does not change it.
    pub unit: Option<Unit>,
    /// Unit that files of this format usually have.
    pub conventional_unit: Option<Unit>,
    /// Name of the format, such as `VTK XML PolyData`.
    pub format: &'static str,
    /// Whether the file states that its lines are separate vessels. Such lines are not joined.
    pub joined: bool,
    /// Notes for the user, one sentence each.
    pub notes: Vec<String>,
}

/// Text in files that this crate writes. It states that their lines are already vessels.
pub(crate) const JOINED_MARK: &str = "LumencutVessels";

/// Largest plausible coordinate or radius (mm). Larger ones mean damaged or misread data. The core uses the
/// same limit.
const LARGEST_COORDINATE: f64 = 1e6;

pub(crate) struct Limit {
    largest: f64,
    unit: &'static str,
}

impl Limit {
    /// The limit in a unit. An unknown unit counts as the smallest one, which allows the largest numbers.
    pub(crate) fn of(unit: Option<Unit>) -> Self {
        let assumed = unit.unwrap_or(Unit::Micrometre);
        Self { largest: LARGEST_COORDINATE / assumed.in_mm(), unit: unit.map_or("", Unit::name) }
    }

    fn text(&self) -> String {
        format!("{:e} {}", self.largest, self.unit).trim_end().to_owned()
    }
}

impl Centerlines {
    /// An empty result for a file format that usually is in mm.
    pub(crate) fn of(format: &'static str) -> Self {
        Self { format, conventional_unit: Some(Unit::Millimetre), ..Self::default() }
    }

    pub(crate) fn note_once(&mut self, note: String) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Replaces NaN radii by 0, or by None if all radii of a line are NaN. Adds a note with their number.
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

    /// If all radii are 0, treats them as missing, because some programs write 0 for missing radii.
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

    /// Adds a note if unnamed columns may hold voxel indices, and one if the fourth was taken as radius.
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

    /// Checks every line. Removes repeated points and lines with one point, and adds a note about that.
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

    /// Multiplies points and radii by `factor`, so that they are in mm, as
    /// [`junctions::vessels`](crate::junctions::vessels) requires. Fails for an invalid factor, or a result
    /// above 1e6 mm.
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
